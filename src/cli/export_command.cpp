// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/export_command.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <deque>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "case_io/bone_normals.hpp"
#include "case_io/case_folder.hpp"
#include "case_io/dicom_segmentation.hpp"
#include "case_io/glb.hpp"
#include "case_io/surface_file.hpp"
#include "case_io/three_mf.hpp"
#include "case_io/write_volume.hpp"
#include "cli/operation_files.hpp"
#include "core/error.hpp"
#include "core/version.hpp"
#include "records/atomic_file.hpp"

namespace carpus::cli {
namespace {

namespace fs = std::filesystem;

struct Arguments {
  fs::path case_folder = kDefaultCase;
  fs::path out;
  std::vector<std::string> bones;
  bool force = false;
};

std::string ending_of(const fs::path& file) {
  const std::string name = file.filename().string();
  for (const char* known :
       {".nii.gz", ".nrrd", ".mha", ".dcm", ".glb", ".3mf", ".ply", ".stl", ".obj", ".off"}) {
    if (name.ends_with(known)) return known;
  }
  throw UsageError(
      "--out: end its name in .3mf or .glb (all bones in one file), .dcm (labels as DICOM "
      "segmentation), .nii.gz, .nrrd or .mha (labels as a volume), or give a name with {} and "
      ".stl, .ply, .obj or .off (one file a bone, as in bones/{}.stl)");
}

std::string name_of(const cases::Bone& bone) {
  return std::string(carpus::name_of(bone.bone, bone.part));
}

std::vector<const cases::Bone*> chosen_bones(const cases::CaseData& data, const Arguments& a) {
  std::vector<const cases::Bone*> chosen;
  for (const cases::Bone& bone : data.bones) {
    if (a.bones.empty() ||
        std::find(a.bones.begin(), a.bones.end(), name_of(bone)) != a.bones.end()) {
      chosen.push_back(&bone);
    }
  }
  for (const std::string& wished : a.bones) {
    const bool is_there = std::any_of(data.bones.begin(), data.bones.end(),
                                      [&](const auto& bone) { return name_of(bone) == wished; });
    if (is_there) continue;
    std::string there;
    for (const cases::Bone& bone : data.bones) there += (there.empty() ? "" : ", ") + name_of(bone);
    throw UsageError("--bones: this case has no '" + wished + "'; it has " + there);
  }
  return chosen;
}

void refuse_existing(const fs::path& file, bool force) {
  if (!force && fs::exists(file)) {
    throw IoError(file.string() + ": exists; give another name or --force to replace it");
  }
}

using Bones = std::vector<const cases::Bone*>;

void write_one_a_bone(const Arguments& a, const cases::CaseData& data, const Bones& bones) {
  const std::string pattern = a.out.string();
  const std::size_t place = pattern.find("{}");
  if (place == std::string::npos) {
    throw UsageError("--out: " + ending_of(a.out) +
                     " holds one bone a file; put {} where its name is to stand, as in bones/{}" +
                     ending_of(a.out));
  }
  std::vector<fs::path> files;
  for (const cases::Bone* bone : bones) {
    files.push_back(std::string(pattern).replace(place, 2, name_of(*bone)));
    refuse_existing(files.back(), a.force);
  }
  for (std::size_t i = 0; i < bones.size(); ++i) {
    const auto in_patient = bones[i]->patient_from_bone * bones[i]->surface;
    const std::vector<Vec3> normals = case_io::bone_normals(in_patient, {}, data.ct.view());
    records::write_file_atomically(files[i], [&](const fs::path& temporary) {
      case_io::write_surface(temporary, in_patient, normals);
    });
    std::printf("%s\n", files[i].string().c_str());
  }
}

std::vector<case_io::NamedMesh> named(const Bones& bones) {
  std::vector<case_io::NamedMesh> meshes;
  for (const cases::Bone* bone : bones) {
    meshes.push_back({name_of(*bone), &bone->surface, bone->patient_from_bone});
  }
  return meshes;
}

/// Labels of bones that were not chosen become 0.
Grid<std::uint8_t> chosen_labels(const cases::CaseData& data, const Bones& bones) {
  Grid<std::uint8_t> labels = data.labels;
  for (std::uint8_t& label : labels.values()) {
    const bool is_chosen = std::any_of(bones.begin(), bones.end(),
                                       [label](const auto* bone) { return bone->label == label; });
    if (!is_chosen) label = 0;
  }
  return labels;
}

void write_one_file(const Arguments& a, const cases::CaseData& data, const Bones& bones) {
  const std::string ending = ending_of(a.out);
  refuse_existing(a.out, a.force);
  const std::string title = data.pseudonym + (data.provenance.simulated ? " (simulated)" : "");
  records::write_file_atomically(a.out, [&](const fs::path& file) {
    if (ending == ".3mf") {
      case_io::write_3mf(file, named(bones), title);
    } else if (ending == ".dcm") {
      std::vector<case_io::SegmentName> names;
      for (const cases::Bone* bone : bones) names.push_back({bone->label, name_of(*bone)});
      case_io::write_dicom_segmentation(
          file, data.labels.view(), names,
          {data.pseudonym, data.provenance.simulated, kProgramVersion});
    } else {
      const Grid<std::uint8_t> labels = chosen_labels(data, bones);
      case_io::write_volume<std::uint8_t>(file, labels.view(), title);
    }
  });
  std::printf("%s\n", a.out.string().c_str());
}

void run(const Arguments& a) {
  const std::string ending = ending_of(a.out);
  const cases::CaseData data = case_io::read_case(a.case_folder);
  const Bones bones = chosen_bones(data, a);
  const bool is_one_a_bone =
      ending == ".ply" || ending == ".stl" || ending == ".obj" || ending == ".off";
  if (!is_one_a_bone && a.out.string().find("{}") != std::string::npos) {
    throw UsageError("--out: " + ending + " holds all bones in one file; give a name without {}");
  }
  if (is_one_a_bone) {
    write_one_a_bone(a, data, bones);
  } else if (ending == ".glb") {
    refuse_existing(a.out, a.force);
    std::vector<case_io::NamedMesh> meshes = named(bones);
    std::deque<case_io::BoneBitmap> bitmaps;
    for (std::size_t i = 0; i < meshes.size(); ++i) {
      meshes[i].bitmap =
          &bitmaps.emplace_back(case_io::make_bone_bitmap(*bones[i], data.ct.view()));
      meshes[i].normals =
          case_io::bone_normals(bones[i]->surface, bones[i]->patient_from_bone, data.ct.view());
    }
    records::write_file_atomically(a.out, case_io::make_glb(meshes));
    std::printf("%s\n", a.out.string().c_str());
  } else {
    write_one_file(a, data, bones);
  }
}

}  // namespace

void add_export_command(CLI::App& app) {
  auto a = std::make_shared<Arguments>();
  CLI::App* command =
      app.add_subcommand("export", "Write a case's bones or labels for other programs");
  command->add_option("case", a->case_folder, "Case folder")->capture_default_str();
  command
      ->add_option("--out", a->out,
                   "File whose ending says what: .3mf, .glb: all bones; bones/{}.stl (.ply, .obj, "
                   ".off): one file a bone; .dcm: labels as DICOM segmentation; .nii.gz, .nrrd, "
                   ".mha: labels as a volume")
      ->required();
  command->add_option("--bones", a->bones, "These alone, by name: scaphoid, lunate, ...");
  command->add_flag("--force", a->force, "Replace files that exist");
  command->callback([a] { run(*a); });
}

}  // namespace carpus::cli
