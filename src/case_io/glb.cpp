// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "case_io/glb.hpp"

#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#include <tiny_gltf.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <deque>
#include <limits>
#include <sstream>
#include <utility>
#include <vector>

#include "case_io/bone_normals.hpp"
#include "core/error.hpp"
#include "core/units.hpp"

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
  accessor.count =
      values.size() /
      static_cast<std::size_t>(tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(type)));
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

/// glTF's colours of materials are linear.
double linear(double srgb) {
  return srgb <= 0.04045 ? srgb / 12.92 : std::pow((srgb + 0.055) / 1.055, 2.4);
}

std::vector<double> linear_colour(const std::array<double, 3>& srgb) {
  return {linear(srgb[0]), linear(srgb[1]), linear(srgb[2])};
}

tinygltf::Value as_value(const std::array<double, 3>& colour) {
  tinygltf::Value::Array array;
  for (const double c : colour) array.emplace_back(c);
  return tinygltf::Value(array);
}

tinygltf::Value six_fields(const anatomy::Material& m) {
  tinygltf::Value::Object fields;
  fields["diffuse"] = as_value(m.diffuse);
  fields["emissive"] = as_value(m.emissive);
  fields["specular"] = as_value(m.specular);
  fields["ambient"] = tinygltf::Value(m.ambient);
  fields["shininess"] = tinygltf::Value(m.shininess);
  fields["transparency"] = tinygltf::Value(m.transparency);
  tinygltf::Value::Object extras;
  extras["material"] = tinygltf::Value(fields);
  return tinygltf::Value(extras);
}

/// The bytes of a file, at a place divisible by four. @return the view of them.
int add_bytes(tinygltf::Model& model, const std::string& content) {
  std::vector<unsigned char>& bytes = model.buffers.front().data;
  tinygltf::BufferView view;
  view.buffer = 0;
  view.byteOffset = bytes.size();
  view.byteLength = content.size();
  bytes.insert(bytes.end(), content.begin(), content.end());
  bytes.resize((bytes.size() + 3) / 4 * 4);
  model.bufferViews.push_back(std::move(view));
  return static_cast<int>(model.bufferViews.size()) - 1;
}

int add_texture(tinygltf::Model& model, const std::string& name, const BoneBitmap& bitmap) {
  if (model.samplers.empty()) {
    tinygltf::Sampler sampler;
    sampler.magFilter = TINYGLTF_TEXTURE_FILTER_LINEAR;
    sampler.minFilter = TINYGLTF_TEXTURE_FILTER_LINEAR_MIPMAP_LINEAR;
    sampler.wrapS = sampler.wrapT = TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE;
    model.samplers.push_back(sampler);
  }
  tinygltf::Image image;
  image.name = name;
  image.mimeType = "image/png";
  image.bufferView = add_bytes(model, bitmap.png());
  model.images.push_back(std::move(image));
  tinygltf::Texture texture;
  texture.sampler = 0;
  texture.source = static_cast<int>(model.images.size()) - 1;
  model.textures.push_back(std::move(texture));
  return static_cast<int>(model.textures.size()) - 1;
}

/// Of the tissue, and of this bone alone where it has a bitmap.
int add_material(tinygltf::Model& model, const NamedMesh& named) {
  const anatomy::Material& m = anatomy::material_of(named.tissue);
  const std::string name = named.bitmap != nullptr ? m.name + " of the " + named.name : m.name;
  for (std::size_t i = 0; i < model.materials.size(); ++i) {
    if (model.materials[i].name == name) return static_cast<int>(i);
  }
  tinygltf::Material material;
  material.name = name;
  auto& surface = material.pbrMetallicRoughness;
  surface.baseColorFactor = linear_colour(m.diffuse);
  surface.baseColorFactor.push_back(1 - m.transparency);
  surface.metallicFactor = 0;
  surface.roughnessFactor = anatomy::roughness_of(m);
  material.emissiveFactor = linear_colour(m.emissive);
  if (m.transparency > 0) material.alphaMode = "BLEND";
  tinygltf::Value::Object specular;
  tinygltf::Value::Array colour;
  // Half of the light is what the standard's own reflectance (0.04) stands for.
  for (const double c : linear_colour(m.specular)) colour.emplace_back(c / linear(0.5));
  specular["specularColorFactor"] = tinygltf::Value(colour);
  material.extensions["KHR_materials_specular"] = tinygltf::Value(specular);
  if (model.extensionsUsed.empty()) model.extensionsUsed.emplace_back("KHR_materials_specular");
  material.extras = six_fields(m);
  if (named.bitmap != nullptr) {
    surface.baseColorTexture.index = add_texture(model, named.name, *named.bitmap);
  }
  model.materials.push_back(std::move(material));
  return static_cast<int>(model.materials.size()) - 1;
}

/// A surface as it is written: with a bitmap, vertices at its charts' borders stand more than once.
struct Written {
  std::vector<Vec3> vertices;
  std::vector<Vec3> normals;
  std::vector<Triangle> facets;
};

Written as_written(const NamedMesh& named) {
  const TriangleMesh& mesh = *named.mesh;
  const std::vector<Vec3> normals = named.normals.empty() ? smooth_normals(mesh) : named.normals;
  if (named.bitmap == nullptr) return {mesh.vertices, normals, mesh.facets};
  const mesh::TextureAtlas& atlas = named.bitmap->atlas;
  Written written{{}, {}, atlas.facets};
  for (const std::uint32_t v : atlas.sources) {
    written.vertices.push_back(mesh.vertices[v]);
    written.normals.push_back(normals[v]);
  }
  return written;
}

int add_mesh(tinygltf::Model& model, const NamedMesh& named) {
  const Written written = as_written(named);
  const std::vector<float> positions = as_floats(written.vertices);
  std::vector<std::uint32_t> indices;
  indices.reserve(written.facets.size() * 3);
  for (const Triangle& t : written.facets) indices.insert(indices.end(), t.begin(), t.end());
  tinygltf::Primitive primitive;
  primitive.mode = TINYGLTF_MODE_TRIANGLES;
  const int position = add_accessor(model, positions, TINYGLTF_COMPONENT_TYPE_FLOAT,
                                    TINYGLTF_TYPE_VEC3, TINYGLTF_TARGET_ARRAY_BUFFER);
  set_bounds(model.accessors[static_cast<std::size_t>(position)], positions);
  primitive.attributes["POSITION"] = position;
  primitive.attributes["NORMAL"] =
      add_accessor(model, as_floats(written.normals), TINYGLTF_COMPONENT_TYPE_FLOAT,
                   TINYGLTF_TYPE_VEC3, TINYGLTF_TARGET_ARRAY_BUFFER);
  if (named.bitmap != nullptr) {
    std::vector<float> uv;
    for (const auto& place : named.bitmap->atlas.uv) {
      for (const double c : place) uv.push_back(static_cast<float>(c));
    }
    primitive.attributes["TEXCOORD_0"] = add_accessor(
        model, uv, TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_VEC2, TINYGLTF_TARGET_ARRAY_BUFFER);
  }
  primitive.indices = add_accessor(model, indices, TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT,
                                   TINYGLTF_TYPE_SCALAR, TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER);
  primitive.material = add_material(model, named);
  tinygltf::Mesh gltf_mesh;
  gltf_mesh.name = named.name;
  gltf_mesh.primitives.push_back(std::move(primitive));
  model.meshes.push_back(std::move(gltf_mesh));
  return static_cast<int>(model.meshes.size()) - 1;
}

tinygltf::Node node_for(const NamedMesh& named, int mesh) {
  tinygltf::Node node;
  node.name = named.name;
  if (named.is_generated) {
    tinygltf::Value::Object extras;
    extras["generated"] = tinygltf::Value(true);
    node.extras = tinygltf::Value(extras);
  }
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

/// A tube's surface: a ring of corners about each point of its line, closed by a corner at each
/// end.
struct TubeSurface {
  TriangleMesh mesh;
  std::vector<float> hand_share;  ///< by vertex
};

TubeSurface surface_of(const cases::Structure& s) {
  constexpr std::uint32_t kCorners = 10;
  TubeSurface tube;
  const std::size_t count = s.course.size();
  const auto add = [&](const Vec3& at, double share) {
    tube.mesh.vertices.push_back(at);
    tube.hand_share.push_back(static_cast<float>(share));
  };
  Vec3 side;
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3& before = s.course[i > 0 ? i - 1 : 0].at;
    const Vec3& after = s.course[std::min(i + 1, count - 1)].at;
    const Vec3 along = normalized_or(after - before, {0, 0, 1});
    // The ring is carried on from the one before, so that the surface does not twist.
    side = i == 0 ? any_perpendicular(along)
                  : normalized_or(side - along * dot(side, along), any_perpendicular(along));
    const Vec3 up = cross(along, side);
    for (std::uint32_t k = 0; k < kCorners; ++k) {
      const double angle = 2 * kPi * k / kCorners;
      add(s.course[i].at + (side * std::cos(angle) + up * std::sin(angle)) * s.radius_mm,
          s.course[i].hand_share);
    }
  }
  const auto rings = static_cast<std::uint32_t>(count);
  const std::uint32_t first = rings * kCorners;
  add(s.course.front().at, s.course.front().hand_share);
  add(s.course.back().at, s.course.back().hand_share);
  for (std::uint32_t k = 0; k < kCorners; ++k) {
    const std::uint32_t next = (k + 1) % kCorners;
    for (std::uint32_t i = 0; i + 1 < rings; ++i) {
      const std::uint32_t a = i * kCorners;
      const std::uint32_t b = a + kCorners;
      tube.mesh.facets.push_back({a + k, a + next, b + next});
      tube.mesh.facets.push_back({a + k, b + next, b + k});
    }
    tube.mesh.facets.push_back({first, next, k});
    const std::uint32_t last = (rings - 1) * kCorners;
    tube.mesh.facets.push_back({first + 1, last + k, last + next});
  }
  return tube;
}

anatomy::Tissue tissue_of(anatomy::StructureKind kind) {
  switch (kind) {
    case anatomy::StructureKind::Artery:
      return anatomy::Tissue::Artery;
    case anatomy::StructureKind::Nerve:
      return anatomy::Tissue::Nerve;
    case anatomy::StructureKind::Tendon:
      break;
  }
  return anatomy::Tissue::Tendon;
}

tinygltf::Node add_tube(tinygltf::Model& model, const cases::Structure& s) {
  const TubeSurface tube = surface_of(s);
  const int mesh = add_mesh(model, {s.id, &tube.mesh, {}, tissue_of(s.kind)});
  model.meshes.back().primitives.front().attributes["_HAND_SHARE"] =
      add_accessor(model, tube.hand_share, TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_SCALAR,
                   TINYGLTF_TARGET_ARRAY_BUFFER);
  tinygltf::Node node;
  node.name = s.id;
  node.mesh = mesh;
  tinygltf::Value::Object extras;
  extras["structure"] = tinygltf::Value(std::string(anatomy::name_of(s.kind)));
  extras["title"] = tinygltf::Value(s.name);
  extras["forearm"] = tinygltf::Value(std::string(name_of(s.forearm)));
  extras["generated"] = tinygltf::Value(true);
  node.extras = tinygltf::Value(extras);
  return node;
}

template <typename T>
int add_scalars(tinygltf::Model& model, const std::vector<T>& values) {
  std::vector<float> floats;
  for (const T& value : values) floats.push_back(static_cast<float>(value));
  return add_accessor(model, floats, TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_SCALAR,
                      TINYGLTF_TARGET_ARRAY_BUFFER);
}

tinygltf::Node add_joint(tinygltf::Model& model, const arthroscopy::JointWall& joint) {
  const std::string name = "joint_wall_" + joint.joint;
  const int mesh = add_mesh(model, {name, &joint.surface, {}});
  auto& attributes = model.meshes.back().primitives.front().attributes;
  attributes["_LINING"] = add_scalars(model, joint.lining);
  attributes["_FIBRE"] = add_accessor(model, as_floats(joint.fibre), TINYGLTF_COMPONENT_TYPE_FLOAT,
                                      TINYGLTF_TYPE_VEC3, TINYGLTF_TARGET_ARRAY_BUFFER);
  attributes["_PROXIMAL"] = add_scalars(model, joint.proximal);
  attributes["_DISTAL"] = add_scalars(model, joint.distal);
  attributes["_DISTAL_SHARE"] = add_scalars(model, joint.distal_share);
  std::vector<float> bodies;
  std::vector<float> shares;
  for (const arthroscopy::Carried& one : joint.carried) {
    bodies.insert(bodies.end(), one.body.begin(), one.body.end());
    shares.insert(shares.end(), one.share.begin(), one.share.end());
  }
  for (const auto& [name_of_it, values] : {std::pair{"_BODIES", &bodies}, {"_SHARES", &shares}}) {
    attributes[name_of_it] = add_accessor(model, *values, TINYGLTF_COMPONENT_TYPE_FLOAT,
                                          TINYGLTF_TYPE_VEC4, TINYGLTF_TARGET_ARRAY_BUFFER);
  }
  tinygltf::Node node;
  node.name = name;
  node.mesh = mesh;
  tinygltf::Value::Object extras;
  extras["generated"] = tinygltf::Value(true);
  extras["joint"] = tinygltf::Value(joint.joint);
  node.extras = tinygltf::Value(extras);
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

std::string make_glb(std::span<const NamedMesh> meshes,
                     std::span<const NamedTube> tubes,
                     std::span<const arthroscopy::JointWall> joints) {
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
  for (const NamedTube& named : tubes) {
    if (named.structure == nullptr || named.structure->course.size() < 2) continue;
    tinygltf::Node node = add_tube(model, *named.structure);
    scene.nodes.push_back(static_cast<int>(model.nodes.size()));
    model.nodes.push_back(std::move(node));
  }
  for (const arthroscopy::JointWall& joint : joints) {
    if (joint.surface.facets.empty()) continue;
    tinygltf::Node node = add_joint(model, joint);
    scene.nodes.push_back(static_cast<int>(model.nodes.size()));
    model.nodes.push_back(std::move(node));
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

std::string make_case_glb(const cases::CaseData& data,
                          std::span<const arthroscopy::JointWall> joints,
                          std::span<const NamedMesh> besides) {
  std::vector<NamedMesh> meshes;
  std::deque<BoneBitmap> bitmaps;
  for (const cases::Bone& bone : data.bones) {
    NamedMesh named{std::string(name_of(bone.bone, bone.part)), &bone.surface,
                    bone.patient_from_bone};
    if (!bone.surface.facets.empty()) {
      named.bitmap = &bitmaps.emplace_back(make_bone_bitmap(bone, data.ct.view()));
      named.normals = bone_normals(bone.surface, bone.patient_from_bone, data.ct.view());
    }
    meshes.push_back(std::move(named));
  }
  meshes.push_back({"skin", &data.skin, {}, anatomy::Tissue::Skin});
  meshes.insert(meshes.end(), besides.begin(), besides.end());
  std::vector<NamedTube> tubes;
  for (const cases::Structure& structure : data.structures) tubes.push_back({&structure});
  return make_glb(meshes, tubes, joints);
}

}  // namespace carpus::case_io
