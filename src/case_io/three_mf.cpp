// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "case_io/three_mf.hpp"

#include <Common/Platform/NMR_ExportStream_Callback.h>
#include <Model/COM/NMR_DLLInterfaces.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <string>
#include <vector>

#include "case_io/detail/disk_space.hpp"
#include "core/error.hpp"

namespace carpus::case_io {
namespace {

/// What lib3mf hands out, released when it goes.
template <typename T>
class Held {
 public:
  Held() = default;
  ~Held() {
    if (object_ != nullptr) NMR::lib3mf_release(object_);
  }
  Held(const Held&) = delete;
  Held& operator=(const Held&) = delete;
  T** out() { return &object_; }
  operator T*() const { return object_; }  // NOLINT(google-explicit-constructor)

 private:
  T* object_ = nullptr;
};

void require(LIB3MFRESULT result, const std::string& what) {
  if (result != LIB3MF_OK) {
    throw InvalidInput("3mf: " + what + " cannot be told to the file (lib3mf's error " +
                       std::to_string(static_cast<long>(result)) + ")");
  }
}

void add_object(NMR::PLib3MFModel* model, const NamedMesh& named) {
  const TriangleMesh& mesh = *named.mesh;
  constexpr std::size_t kMost = std::numeric_limits<int>::max();
  if (mesh.facets.empty() || mesh.vertices.size() > kMost || mesh.facets.size() > kMost) {
    throw InvalidInput("3mf: " + named.name + " is no surface that the format holds");
  }
  std::vector<NMR::MODELMESHVERTEX> vertices;
  vertices.reserve(mesh.vertices.size());
  for (const Vec3& v : mesh.vertices) {
    const Vec3 p = (named.patient_from_bone * Point<frame::Bone>{v}).v;
    vertices.push_back(
        {{static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)}});
  }
  std::vector<NMR::MODELMESHTRIANGLE> triangles;
  triangles.reserve(mesh.facets.size());
  for (const Triangle& t : mesh.facets) triangles.push_back({{t[0], t[1], t[2]}});
  Held<NMR::PLib3MFModelMeshObject> object;
  require(NMR::lib3mf_model_addmeshobject(model, object.out()), named.name);
  require(NMR::lib3mf_object_setnameutf8(object, named.name.c_str()), named.name);
  require(NMR::lib3mf_meshobject_setgeometry(object, vertices.data(),
                                             static_cast<DWORD>(vertices.size()), triangles.data(),
                                             static_cast<DWORD>(triangles.size())),
          named.name);
  Held<NMR::PLib3MFModelBuildItem> item;
  require(NMR::lib3mf_model_addbuilditem(model, object, nullptr, item.out()), named.name);
}

/// What the writer makes, in memory: on a disk that is full its destructor throws, which ends the
/// program.
struct Made {
  std::string bytes;
  std::size_t at = 0;
};

constexpr NMR::nfUint32 kTaken = 0;

NMR::nfUint32 take_bytes(NMR::nfByte* data, NMR::nfUint32 count, void* made) {
  auto& to = *static_cast<Made*>(made);
  to.bytes.resize(std::max(to.bytes.size(), to.at + count));
  std::copy_n(data, count, to.bytes.begin() + static_cast<std::ptrdiff_t>(to.at));
  to.at += count;
  return kTaken;
}

NMR::nfUint32 take_place(NMR::nfUint64 place, void* made) {
  static_cast<Made*>(made)->at = static_cast<std::size_t>(place);
  return kTaken;
}

}  // namespace

void write_3mf(const std::filesystem::path& file,
               std::span<const NamedMesh> meshes,
               const std::string& title) {
  Held<NMR::PLib3MFModel> model;
  require(NMR::lib3mf_createmodel(model.out()), "the model");
  require(NMR::lib3mf_model_setunit(model, NMR::MODELUNIT_MILLIMETER), "the unit");
  require(NMR::lib3mf_model_addmetadatautf8(model, "Title", title.c_str()), "the title");
  for (const NamedMesh& named : meshes) add_object(model, named);
  Held<NMR::PLib3MFModelWriter> writer;
  require(NMR::lib3mf_model_querywriter(model, "3mf", writer.out()), "the writer");
  Made made;
  require(NMR::lib3mf_writer_writetocallback(writer, reinterpret_cast<void*>(take_bytes),
                                             reinterpret_cast<void*>(take_place), &made),
          "what was made");
  std::ofstream out(file, std::ios::binary);
  out.write(made.bytes.data(), static_cast<std::streamsize>(made.bytes.size()));
  out.close();
  if (!out) throw_cannot_write(file);
}

}  // namespace carpus::case_io
