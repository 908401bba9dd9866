// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "case_io/glb.hpp"

#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#include <tiny_gltf.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <sstream>
#include <vector>

#include "core/error.hpp"

namespace carpus::case_io {
namespace {

/// Appends values to the model's only buffer and returns the accessor that describes them.
template <typename T>
int add_accessor(tinygltf::Model& model,
                 const std::vector<T>& values,
                 int component,
                 int type,
                 int target) {
  std::vector<unsigned char>& bytes = model.buffers.front().data;
  tinygltf::BufferView view;
  view.buffer = 0;
  view.byteOffset = bytes.size();
  view.byteLength = values.size() * sizeof(T);
  view.target = target;
  bytes.resize(bytes.size() + view.byteLength);
  std::memcpy(bytes.data() + view.byteOffset, values.data(), view.byteLength);
  tinygltf::Accessor accessor;
  accessor.bufferView = static_cast<int>(model.bufferViews.size());
  accessor.componentType = component;
  accessor.type = type;
  accessor.count = type == TINYGLTF_TYPE_VEC3 ? values.size() / 3 : values.size();
  model.bufferViews.push_back(std::move(view));
  model.accessors.push_back(std::move(accessor));
  return static_cast<int>(model.accessors.size()) - 1;
}

std::vector<float> as_floats(const std::vector<Vec3>& points) {
  std::vector<float> values;
  values.reserve(points.size() * 3);
  for (const Vec3& p : points) {
    for (std::size_t i = 0; i < 3; ++i) values.push_back(static_cast<float>(p[i]));
  }
  return values;
}

/// The standard asks for the positions' bounds.
void set_bounds(tinygltf::Accessor& accessor, const std::vector<float>& positions) {
  accessor.minValues.assign(3, std::numeric_limits<double>::infinity());
  accessor.maxValues.assign(3, -std::numeric_limits<double>::infinity());
  for (std::size_t i = 0; i < positions.size(); ++i) {
    const double v = static_cast<double>(positions[i]);
    accessor.minValues[i % 3] = std::min(accessor.minValues[i % 3], v);
    accessor.maxValues[i % 3] = std::max(accessor.maxValues[i % 3], v);
  }
}

int add_mesh(tinygltf::Model& model, const NamedMesh& named) {
  const TriangleMesh& mesh = *named.mesh;
  const std::vector<float> positions = as_floats(mesh.vertices);
  std::vector<std::uint32_t> indices;
  indices.reserve(mesh.facets.size() * 3);
  for (const Triangle& t : mesh.facets) indices.insert(indices.end(), t.begin(), t.end());
  tinygltf::Primitive primitive;
  primitive.mode = TINYGLTF_MODE_TRIANGLES;
  const int position = add_accessor(model, positions, TINYGLTF_COMPONENT_TYPE_FLOAT,
                                    TINYGLTF_TYPE_VEC3, TINYGLTF_TARGET_ARRAY_BUFFER);
  set_bounds(model.accessors[static_cast<std::size_t>(position)], positions);
  primitive.attributes["POSITION"] = position;
  primitive.attributes["NORMAL"] =
      add_accessor(model, as_floats(smooth_normals(mesh)), TINYGLTF_COMPONENT_TYPE_FLOAT,
                   TINYGLTF_TYPE_VEC3, TINYGLTF_TARGET_ARRAY_BUFFER);
  primitive.indices = add_accessor(model, indices, TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT,
                                   TINYGLTF_TYPE_SCALAR, TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER);
  tinygltf::Mesh gltf_mesh;
  gltf_mesh.name = named.name;
  gltf_mesh.primitives.push_back(std::move(primitive));
  model.meshes.push_back(std::move(gltf_mesh));
  return static_cast<int>(model.meshes.size()) - 1;
}

tinygltf::Node node_for(const NamedMesh& named, int mesh) {
  tinygltf::Node node;
  node.name = named.name;
  node.mesh = mesh;
  const auto& pose = named.patient_from_bone;
  if (pose == Pose<frame::Patient, frame::Bone>{}) return node;
  node.matrix.assign(16, 0.0);  // column-major
  for (std::size_t column = 0; column < 3; ++column) {
    for (std::size_t row = 0; row < 3; ++row) {
      node.matrix[column * 4 + row] = pose.rotation.rows[row][column];
    }
    node.matrix[12 + column] = pose.translation[column];
  }
  node.matrix[15] = 1.0;
  return node;
}

}  // namespace

std::vector<Vec3> smooth_normals(const TriangleMesh& mesh) {
  std::vector<Vec3> normals(mesh.vertices.size());
  for (const Triangle& t : mesh.facets) {
    const Vec3& a = mesh.vertices[t[0]];
    const Vec3 twice_area = cross(mesh.vertices[t[1]] - a, mesh.vertices[t[2]] - a);
    for (const std::uint32_t v : t) normals[v] += twice_area;
  }
  for (Vec3& n : normals) n = normalized_or(n, {0, 0, 1});
  return normals;
}

std::string make_glb(std::span<const NamedMesh> meshes) {
  tinygltf::Model model;
  model.asset.version = "2.0";
  model.asset.generator = "carpus";
  model.buffers.emplace_back();
  tinygltf::Scene scene;
  for (const NamedMesh& named : meshes) {
    if (named.mesh == nullptr || named.mesh->facets.empty()) continue;
    const int mesh = add_mesh(model, named);
    scene.nodes.push_back(static_cast<int>(model.nodes.size()));
    model.nodes.push_back(node_for(named, mesh));
  }
  if (model.nodes.empty()) model.buffers.clear();  // the standard knows no empty buffer
  model.scenes.push_back(std::move(scene));
  model.defaultScene = 0;
  std::ostringstream out;
  tinygltf::TinyGLTF writer;
  if (!writer.WriteGltfSceneToStream(&model, out, false, true)) {
    throw InvalidInput("the surfaces could not be written as glTF");
  }
  return out.str();
}

std::string make_case_glb(const cases::CaseData& data) {
  std::vector<NamedMesh> meshes;
  for (const cases::Bone& bone : data.bones) {
    meshes.push_back(
        {std::string(name_of(bone.bone, bone.part)), &bone.surface, bone.patient_from_bone});
  }
  meshes.push_back({"skin", &data.skin, {}});
  return make_glb(meshes);
}

}  // namespace carpus::case_io
