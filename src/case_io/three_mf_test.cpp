// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "case_io/three_mf.hpp"

#include <Model/COM/NMR_DLLInterfaces.h>
#include <gtest/gtest.h>
#include <stdlib.h>

#include <string>

#include "core/error.hpp"

namespace carpus::case_io {
namespace {

TriangleMesh tetrahedron() {
  return {{{0, 0, 0}, {10, 0, 0}, {0, 10, 0}, {0, 0, 10}},
          {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
}

TEST(ThreeMf, IsReadBackByItsLibraryWithNamesPlacesAndUnit) {
  std::string folder = testing::TempDir() + "/3mf_XXXXXX";
  ASSERT_NE(::mkdtemp(folder.data()), nullptr);
  const std::string file = folder + "/bones.3mf";
  const TriangleMesh mesh = tetrahedron();
  NamedMesh moved{"lunate", &mesh, {}};
  moved.patient_from_bone.translation = {1, 2, 3};
  write_3mf(file, std::vector<NamedMesh>{{"scaphoid", &mesh, {}}, moved}, "a wrist (simulated)");

  NMR::PLib3MFModel* model = nullptr;
  ASSERT_EQ(NMR::lib3mf_createmodel(&model), LIB3MF_OK);
  NMR::PLib3MFModelReader* reader = nullptr;
  ASSERT_EQ(NMR::lib3mf_model_queryreader(model, "3mf", &reader), LIB3MF_OK);
  ASSERT_EQ(NMR::lib3mf_reader_readfromfileutf8(reader, file.c_str()), LIB3MF_OK);
  DWORD unit = 0;
  NMR::lib3mf_model_getunit(model, &unit);
  EXPECT_EQ(unit, NMR::MODELUNIT_MILLIMETER);
  NMR::PLib3MFModelResourceIterator* objects = nullptr;
  ASSERT_EQ(NMR::lib3mf_model_getmeshobjects(model, &objects), LIB3MF_OK);
  const char* const names[] = {"scaphoid", "lunate"};
  for (int i = 0; i < 2; ++i) {
    BOOL has_next = 0;
    NMR::lib3mf_resourceiterator_movenext(objects, &has_next);
    ASSERT_TRUE(has_next);
    NMR::PLib3MFModelResource* object = nullptr;
    ASSERT_EQ(NMR::lib3mf_resourceiterator_getcurrent(objects, &object), LIB3MF_OK);
    char name[64] = {};
    NMR::lib3mf_object_getnameutf8(object, name, sizeof name, nullptr);
    EXPECT_STREQ(name, names[i]);
    DWORD count = 0;
    NMR::lib3mf_meshobject_gettrianglecount(object, &count);
    EXPECT_EQ(count, 4U);
    NMR::MODELMESHVERTEX vertex{};
    NMR::lib3mf_meshobject_getvertex(object, 1, &vertex);
    EXPECT_FLOAT_EQ(vertex.m_fPosition[0], i == 0 ? 10.0F : 11.0F);
    EXPECT_FLOAT_EQ(vertex.m_fPosition[2], i == 0 ? 0.0F : 3.0F);
    NMR::lib3mf_release(object);
  }
  NMR::lib3mf_release(objects);
  NMR::lib3mf_release(reader);
  NMR::lib3mf_release(model);
}

TEST(ThreeMf, RefusesWhatIsNoSurfaceAndSaysWhereItCannotWrite) {
  const TriangleMesh empty;
  EXPECT_THROW(write_3mf("x.3mf", std::vector<NamedMesh>{{"skin", &empty, {}}}, ""), InvalidInput);
  const TriangleMesh mesh = tetrahedron();
  EXPECT_THROW(write_3mf("/nowhere/at/all/x.3mf", std::vector<NamedMesh>{{"a", &mesh, {}}}, "t"),
               IoError);
  // Larger than what its library holds back, on a disk that is always full.
  TriangleMesh large;
  for (std::uint32_t i = 0; i < 20'000; ++i) {
    const double at = 0.1 * i;
    for (const Vec3& v : mesh.vertices) large.vertices.push_back({v.x + at, v.y, v.z - at / 3});
    for (const Triangle& t : mesh.facets) {
      large.facets.push_back({t[0] + 4 * i, t[1] + 4 * i, t[2] + 4 * i});
    }
  }
  EXPECT_THROW(write_3mf("/dev/full", std::vector<NamedMesh>{{"a", &large, {}}}, "t"), IoError);
}

}  // namespace
}  // namespace carpus::case_io
