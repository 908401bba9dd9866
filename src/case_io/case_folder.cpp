// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "case_io/case_folder.hpp"

#include <cmath>
#include <cstddef>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "case_io/bone_normals.hpp"
#include "case_io/detail/case_json.hpp"
#include "case_io/detail/damaged_file.hpp"
#include "case_io/detail/disk_space.hpp"
#include "case_io/detail/hand_motion_json.hpp"
#include "case_io/detail/hull_from_mesh.hpp"
#include "case_io/detail/regular_file.hpp"
#include "case_io/detail/structures_json.hpp"
#include "case_io/detail/volume_file.hpp"
#include "case_io/glb.hpp"
#include "case_io/lesson_file.hpp"
#include "case_io/pathology_file.hpp"
#include "case_io/ply.hpp"
#include "case_io/write_volume.hpp"
#include "core/error.hpp"
#include "core/parallel.hpp"

namespace carpus::case_io {
namespace fs = std::filesystem;
namespace {

/// A volume file may differ from case.json by its format's rounding, here over the whole grid [mm].
constexpr double kSamePlaceMm = 1e-3;

constexpr const char* kHandMotionFile = "hand_motion.json";

void write_text(const fs::path& file, const std::string& text) {
  std::ofstream out(file, std::ios::binary);
  out.write(text.data(), static_cast<std::streamsize>(text.size()));
  out.close();
  if (!out) throw_cannot_write(file);
}

std::string read_text(const fs::path& file) {
  if (!fs::exists(file)) {
    throw IoError(file.string() +
                  ": is not there; give a case folder made by 'carpus reconstruct'");
  }
  return read_whole_file(file, kLargestCaseJson);
}

std::string bone_name(const cases::Bone& bone) {
  return std::string(name_of(bone.bone, bone.part));
}

void check_complete(const cases::CaseData& data) {
  if (data.ct.values().empty() || data.labels.values().empty() || data.bones.empty()) {
    throw InvalidInput("a case needs a CT, labels and bones; reconstruct it from a CT first");
  }
  for (const cases::Bone& bone : data.bones) {
    if (bone.surface.facets.empty() || bone.hull.facets.empty() ||
        bone.distance_field.values().empty()) {
      throw InvalidInput("the case's " + bone_name(bone) + " lacks surface, hull or field");
    }
  }
}

bool are_alike(const GridGeometry& a, const GridGeometry& b) {
  if (a.size != b.size) return false;
  for (int corner = 0; corner < 8; ++corner) {
    Vec3 v{};
    for (std::size_t i = 0; i < 3; ++i) v[i] = (corner >> i) % 2 == 0 ? 0.0 : a.size[i] - 1;
    if (!(distance(a.patient_from_voxel(v), b.patient_from_voxel(v)) < kSamePlaceMm)) return false;
  }
  return true;
}

/// A volume of the folder, on the grid that case.json gives.
template <typename T>
Grid<T> read_grid(const fs::path& folder, const std::string& name, const CaseHeader& header) {
  const fs::path file = folder / name;
  const auto known = header.grids.find(name);
  if (known == header.grids.end()) {
    throw IoError((folder / "case.json").string() + ": does not describe " + name +
                  "; restore it or make the case again from its CT");
  }
  if (!fs::exists(file)) {
    throw IoError(file.string() + ": is missing; restore it or make the case again from its CT");
  }
  ReadingNotes notes;
  Grid<T> stored = read_volume_file<T>(file, notes);
  if (!are_alike(stored.geometry(), known->second)) {
    throw IoError(file.string() +
                  ": lies elsewhere than case.json says; one of the two was "
                  "changed: make the case again from its CT");
  }
  const ValueCount& count = notes.count;
  if (count.not_finite + count.clamped + count.rounded > 0) {
    throw IoError(file.string() +
                  ": holds values that it cannot have; restore it or make the case "
                  "again from its CT");
  }
  return Grid<T>(known->second, std::vector<T>(stored.values().begin(), stored.values().end()));
}

void read_bone(const fs::path& folder, const CaseHeader& header, cases::Bone& bone) {
  const std::string name = bone_name(bone);
  const fs::path surface_file = folder / "bones" / (name + ".ply");
  bone.surface = MeshIn<frame::Bone>(read_ply(surface_file));
  if (check_surface(bone.surface) != SurfaceStatus::Ok) {
    throw IoError(surface_file.string() +
                  ": is no closed surface; restore it or make the case again from its CT");
  }
  const fs::path hull_file = folder / "hulls" / (name + ".ply");
  auto hull = hull_from_mesh(read_ply(hull_file), bone.surface.vertices);
  if (!hull) {
    throw IoError(hull_file.string() + ": is no convex hull of bones/" + name +
                  ".ply; restore it or make the case again from its CT");
  }
  bone.hull = std::move(*hull);
  bone.distance_field = read_grid<float>(folder, field_file(bone), header);
}

void write_bone(const fs::path& folder,
                const cases::Bone& bone,
                const GridView<const std::int16_t>& ct) {
  const std::string name = bone_name(bone);
  write_ply(folder / "bones" / (name + ".ply"), bone.surface,
            bone_normals(bone.surface, bone.patient_from_bone, ct));
  write_ply(folder / "hulls" / (name + ".ply"), bone.hull.surface());
  write_volume<float>(folder / field_file(bone), bone.distance_field.view());
}

void write_volumes(const cases::CaseData& data, const fs::path& folder) {
  write_volume<std::int16_t>(folder / "ct.nii.gz", data.ct.view());
  write_volume<std::uint8_t>(folder / "labels.nii.gz", data.labels.view());
}

/// Surfaces, hulls, fields and what else the case has beside its volumes.
void write_shapes(const cases::CaseData& data, const fs::path& folder, const Progress& progress) {
  const auto steps = static_cast<double>(data.bones.size());
  double done = 0;
  for (const cases::Bone& bone : data.bones) {
    write_bone(folder, bone, data.ct.view());
    progress("saving", ++done / steps);
  }
  if (!data.skin.facets.empty()) {
    write_ply(folder / "skin.ply", data.skin, bone_normals(data.skin, {}, data.ct.view()));
  }
  if (!data.hand_motion.is_empty()) {
    write_text(folder / kHandMotionFile, hand_motion_text(data.hand_motion));
  }
  if (!data.structures.empty()) {
    write_text(folder / kStructuresFile, structures_text(data.structures));
  }
  if (data.pathology) write_text(folder / kPathologyFile, pathology_text(*data.pathology));
}

}  // namespace

void write_case(const cases::CaseData& data,
                const fs::path& folder,
                Overwrite overwrite,
                const Progress& progress) {
  check_complete(data);
  progress("saving", 0.0);
  AtomicFolder out(folder, overwrite);
  for (const char* part : {"bones", "hulls", "fields"}) {
    std::error_code error;
    fs::create_directory(out.staging() / part, error);
    if (error) throw_cannot_write(out.staging() / part);
  }
  // Side by side: packing the CT takes as long as all the rest. NIfTI's library is asked by one of
  // them only, and NRRD's by another.
  side_by_side({[&] { write_volumes(data, out.staging()); },
                [&] { write_text(out.staging() / "bones.glb", make_case_glb(data)); },
                [&] { write_shapes(data, out.staging(), progress); }});
  write_text(out.staging() / "case.json", case_json_text(data));
  out.commit();
  progress("saving", 1.0);
}

std::vector<std::pair<std::string, std::string>> structure_files(const cases::CaseData& data) {
  return {{"bones.glb", make_case_glb(data)},
          {kStructuresFile, structures_text(data.structures)},
          {"case.json", case_json_text(data)}};
}

cases::CaseData read_case(const fs::path& folder, const Progress& progress) {
  const fs::path file = folder / "case.json";
  CaseHeader header = parse_case_json(read_text(file), file);
  cases::CaseData& data = header.data;
  const double steps = static_cast<double>(data.bones.size()) + 2;
  double done = 0;
  for (cases::Bone& bone : data.bones) {
    read_bone(folder, header, bone);
    progress("loading", ++done / steps);
  }
  if (fs::exists(folder / "skin.ply")) {
    data.skin = MeshIn<frame::Patient>(read_ply(folder / "skin.ply"));
  }
  if (const fs::path table = folder / kHandMotionFile; fs::exists(table)) {
    data.hand_motion = parse_hand_motion(read_text(table), table);
  }
  const fs::path tubes = folder / kStructuresFile;
  if (header.has_structures && !fs::exists(tubes)) {
    throw damaged_file(tubes, IoError("is not there, though case.json names it"));
  }
  if (fs::exists(tubes)) {
    data.structures = parse_structures(read_text(tubes), tubes);
  }
  data.ct = read_grid<std::int16_t>(folder, "ct.nii.gz", header);
  progress("loading", ++done / steps);
  data.labels = read_grid<std::uint8_t>(folder, "labels.nii.gz", header);
  progress("loading", 1.0);
  data.lesson = read_lesson(folder);
  data.pathology = read_pathology(folder);
  return std::move(header.data);
}

}  // namespace carpus::case_io
