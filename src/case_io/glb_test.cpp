// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "case_io/glb.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>
#include <vector>

#include "case_io/small_case_test_support.hpp"

namespace carpus::case_io {
namespace {

const TriangleMesh kTetrahedron{{{0, 0, 0}, {4, 0, 0}, {0, 5, 0}, {0, 0, 6}},
                                {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}};

std::uint32_t word_at(const std::string& bytes, std::size_t at) {
  std::uint32_t v = 0;
  std::memcpy(&v, bytes.data() + at, sizeof v);
  return v;
}

TEST(Glb, HoldsANamedNodeForEachMesh) {
  Pose<frame::Patient, frame::Bone> moved;
  moved.translation = {7, 8, 9};
  const TriangleMesh empty;
  const std::vector<NamedMesh> meshes{
      {"lunate", &kTetrahedron, {}}, {"skin", &empty, {}}, {"radius", &kTetrahedron, moved}};
  const std::string glb = make_glb(meshes);
  ASSERT_GT(glb.size(), 20U);
  EXPECT_EQ(glb.substr(0, 4), "glTF");
  EXPECT_EQ(word_at(glb, 4), 2U);
  EXPECT_EQ(word_at(glb, 8), glb.size());
  const std::uint32_t json_size = word_at(glb, 12);
  const auto json = nlohmann::json::parse(glb.substr(20, json_size));
  ASSERT_EQ(json.at("nodes").size(), 2U);  // the empty skin is left out
  EXPECT_EQ(json.at("nodes")[0].at("name"), "lunate");
  EXPECT_EQ(json.at("nodes")[1].at("name"), "radius");
  EXPECT_EQ(json.at("nodes")[1].at("matrix")[12], 7);
  const auto& primitive = json.at("meshes")[0].at("primitives")[0];
  const auto& position =
      json.at("accessors")[primitive.at("attributes").at("POSITION").get<std::size_t>()];
  EXPECT_EQ(position.at("count"), 4);
  EXPECT_EQ(position.at("max"), nlohmann::json({4.0, 5.0, 6.0}));
  EXPECT_EQ(json.at("accessors")[primitive.at("indices").get<std::size_t>()].at("count"), 12);
  const std::size_t binary = 20 + json_size + 8;
  float first_x_of_second_vertex = 0;
  std::memcpy(&first_x_of_second_vertex, glb.data() + binary + 12, sizeof(float));
  EXPECT_EQ(first_x_of_second_vertex, 4.0F);
}

TEST(Glb, HoldsAStructureAsATubeThatSaysWhatItIs) {
  const cases::Structure nerve{"dsbun",
                               "dorsal sensory branch of the ulnar nerve",
                               anatomy::StructureKind::Nerve,
                               0.8,
                               BoneId::Ulna,
                               {{{0, 0, 0}, 0}, {{0, 0, 5}, 0.5}, {{1, 0, 10}, 1}}};
  const std::vector<NamedTube> tubes{{&nerve}};
  const std::string glb = make_glb({}, tubes);
  const auto json = nlohmann::json::parse(glb.substr(20, word_at(glb, 12)));
  const auto& node = json.at("nodes")[0];
  EXPECT_EQ(node.at("extras").at("structure"), "nerve");
  EXPECT_EQ(node.at("extras").at("forearm"), "ulna");
  EXPECT_EQ(node.at("extras").at("generated"), true);
  EXPECT_EQ(node.at("extras").at("title"), nerve.name);
  const auto& attributes = json.at("meshes")[0].at("primitives")[0].at("attributes");
  const auto count = [&](const char* name) {
    return json.at("accessors")[attributes.at(name).get<std::size_t>()].at("count");
  };
  EXPECT_EQ(count("_HAND_SHARE"), count("POSITION"));
}

TEST(Glb, GivesEachTissueItsMaterialAndABoneItsBitmap) {
  const cases::Bone lunate = test::octahedron(BoneId::Lunate, BonePart::Whole, 4, {0, 0, 0});
  const Grid<std::int16_t> no_ct;
  const BoneBitmap bitmap = make_bone_bitmap(lunate, no_ct.view(), 64);
  const std::vector<NamedMesh> meshes{
      {"lunate", &lunate.surface, {}, anatomy::Tissue::Bone, &bitmap},
      {"skin", &kTetrahedron, {}, anatomy::Tissue::Skin}};
  const std::string glb = make_glb(meshes);
  const std::uint32_t json_size = word_at(glb, 12);
  const auto json = nlohmann::json::parse(glb.substr(20, json_size));
  const auto& bone = json.at("materials")[0];
  EXPECT_EQ(bone.at("extras").at("material").at("shininess"),
            anatomy::material_of(anatomy::Tissue::Bone).shininess);
  EXPECT_EQ(bone.at("extras").at("material").size(), 6U);
  EXPECT_NEAR(bone.at("pbrMetallicRoughness").at("roughnessFactor").get<double>(), 0.72, 1e-3);
  EXPECT_NEAR(
      bone.at("extensions").at("KHR_materials_specular").at("specularColorFactor")[0].get<double>(),
      1, 1e-12);
  EXPECT_EQ(bone.at("pbrMetallicRoughness").at("baseColorTexture").at("index"), 0);
  EXPECT_EQ(json.at("materials")[1].at("alphaMode"), "BLEND");
  EXPECT_EQ(json.at("extensionsUsed")[0], "KHR_materials_specular");
  // The bitmap's bytes are a PNG, where the file says that it lies.
  const auto& image = json.at("images")[0];
  EXPECT_EQ(image.at("mimeType"), "image/png");
  const auto& view = json.at("bufferViews")[image.at("bufferView").get<std::size_t>()];
  const std::size_t at = 20 + json_size + 8 + view.at("byteOffset").get<std::size_t>();
  EXPECT_EQ(glb.substr(at, view.at("byteLength").get<std::size_t>()), bitmap.png());
  const auto& attributes = json.at("meshes")[0].at("primitives")[0].at("attributes");
  const auto count = [&](const char* name) {
    return json.at("accessors")[attributes.at(name).get<std::size_t>()].at("count");
  };
  EXPECT_EQ(count("TEXCOORD_0"), count("POSITION"));
  EXPECT_EQ(count("POSITION"), bitmap.atlas.sources.size());
}

TEST(Glb, NormalsPointOutwards) {
  const std::vector<Vec3> normals = smooth_normals(kTetrahedron);
  const Vec3 centre{1, 1.25, 1.5};
  for (std::size_t i = 0; i < normals.size(); ++i) {
    EXPECT_NEAR(length(normals[i]), 1, 1e-12);
    EXPECT_GT(dot(normals[i], kTetrahedron.vertices[i] - centre), 0);
  }
}

}  // namespace
}  // namespace carpus::case_io
