// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/segment_command.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "case_io/bone_normals.hpp"
#include "case_io/marker_points.hpp"
#include "case_io/read_volume.hpp"
#include "case_io/surface_file.hpp"
#include "case_io/write_volume.hpp"
#include "cli/simulated_scan.hpp"
#include "cli/stop_request.hpp"
#include "core/error.hpp"
#include "core/text_format.hpp"
#include "figures/segment_pictures.hpp"
#include "imaging/binary_mask.hpp"
#include "imaging/bone_markers.hpp"
#include "imaging/gaussian.hpp"
#include "imaging/marker_ball.hpp"
#include "imaging/watershed.hpp"
#include "mesh/label_surfaces.hpp"
#include "reconstruct/stage_clock.hpp"
#include "records/atomic_file.hpp"

namespace carpus::cli {
namespace {

namespace fs = std::filesystem;
using imaging::RegionLabel;
using imaging::VoxelBox;
using Labels = Grid<RegionLabel>;

constexpr RegionLabel kMostLabel = 255;  // what a label volume holds

struct Arguments {
  fs::path input;
  fs::path out;
  fs::path markers;
  fs::path markers_out;
  fs::path pictures;
  fs::path surfaces;
  fs::path json;
  std::string series;
  std::vector<double> region;
  double sigma_mm = 0.3;
  int neighbours = 0;
  int outside = 0;
  int slice = -1;
  bool slices = false;
  bool dams = false;
  bool force = false;
};

void warn(const std::string& text) { std::fprintf(stderr, "carpus: warning: %s\n", text.c_str()); }

imaging::Connectivity connectivity_of(const Arguments& a) {
  const int n = a.neighbours == 0 ? (a.slices ? 4 : 6) : a.neighbours;
  if (a.slices) {
    if (n == 4) return imaging::Connectivity::Faces;
    if (n == 8) return imaging::Connectivity::Edges;
    throw UsageError("--neighbours: in slices a voxel has 4 or 8");
  }
  if (n == 6) return imaging::Connectivity::Faces;
  if (n == 18) return imaging::Connectivity::Edges;
  if (n == 26) return imaging::Connectivity::Corners;
  throw UsageError("--neighbours: in a volume a voxel has 6, 18 or 26; see --slices for 4 and 8");
}

/// The voxels whose centres lie between two corners in mm of Patient.
VoxelBox box_between(const GridGeometry& g, const std::vector<double>& mm) {
  const Vec3 a = g.voxel_from_patient({mm[0], mm[1], mm[2]});
  const Vec3 b = g.voxel_from_patient({mm[3], mm[4], mm[5]});
  VoxelBox box;
  const auto cut = [](double from, double to, int size, int& low, int& high) {
    if (!(std::min(from, to) <= size - 1 && std::max(from, to) >= 0)) return false;
    low = static_cast<int>(std::ceil(std::clamp(std::min(from, to), 0.0, size - 1.0)));
    high = static_cast<int>(std::floor(std::clamp(std::max(from, to), 0.0, size - 1.0)));
    return low <= high;
  };
  if (!cut(a.x, b.x, g.size[0], box.low.x, box.high.x) ||
      !cut(a.y, b.y, g.size[1], box.low.y, box.high.y) ||
      !cut(a.z, b.z, g.size[2], box.low.z, box.high.z)) {
    const Vec3 last = g.patient_from_voxel({g.size[0] - 1.0, g.size[1] - 1.0, g.size[2] - 1.0});
    throw InvalidInput(
        format("--region holds no voxel; the scan goes from %.1f,%.1f,%.1f to %.1f,%.1f,%.1f mm",
               g.origin.x, g.origin.y, g.origin.z, last.x, last.y, last.z));
  }
  return box;
}

VoxelBox whole_of(const GridGeometry& g) {
  return {{0, 0, 0}, {g.size[0] - 1, g.size[1] - 1, g.size[2] - 1}};
}

/// What is flooded: a part of the scan and its markers.
struct Task {
  Grid<std::int16_t> hu;
  Labels markers;
  VoxelIndex offset;  ///< of the part, in the scan
  RegionLabel outside = 0;
};

Task find_markers(const Grid<std::int16_t>& part, const VoxelIndex& offset, const Arguments& a) {
  imaging::BoneSegmentationOptions options;
  options.edge_sigma_mm = a.sigma_mm;
  auto found =
      imaging::find_bone_markers(part.view(), options, [](std::string_view stage, double fraction) {
        StopRequest::show_or_stop(stage, 0.1 + 0.5 * fraction);
      });
  if (found.status != imaging::SegmentationStatus::Ok) {
    throw InvalidInput("no bone was found to put a marker in (densest value " +
                       std::to_string(std::lround(found.densest_hu)) +
                       " HU); is this a CT in HU? Else give --markers");
  }
  const auto& size = found.markers.geometry().size;
  const VoxelIndex& low = found.offset;
  const VoxelBox box{low, {low.x + size[0] - 1, low.y + size[1] - 1, low.z + size[2] - 1}};
  Task task{imaging::crop(part.view(), box), std::move(found.markers), offset, found.outside()};
  task.offset = {offset.x + found.offset.x, offset.y + found.offset.y, offset.z + found.offset.z};
  return task;
}

Labels read_markers(const GridGeometry& g, const fs::path& file) {
  Labels markers(g);
  if (file.extension() == ".csv") {
    for (const case_io::MarkerPoint& m : case_io::read_marker_points(file)) {
      if (!imaging::paint_ball({static_cast<RegionLabel>(m.label), m.place, m.radius_mm},
                               markers.view())) {
        throw InvalidInput(file.string() +
                           format(": the marker of label %d at %g, %g, %g mm", m.label, m.place.x,
                                  m.place.y, m.place.z) +
                           " lies outside the scan; places are in mm of the patient (LPS)");
      }
    }
    return markers;
  }
  const Grid<std::uint8_t> volume = case_io::read_labels(file);
  if (volume.geometry().size != g.size || distance(volume.geometry().origin, g.origin) > 0.01 ||
      distance(volume.geometry().spacing, g.spacing) > 1e-4) {
    throw InvalidInput(file.string() +
                       ": is not on the grid of the CT; paint markers on the same scan, uncropped");
  }
  std::copy(volume.values().begin(), volume.values().end(), markers.values().begin());
  return markers;
}

Task take_markers(const Grid<std::int16_t>& ct, const VoxelBox& box, const Arguments& a) {
  const Labels markers = read_markers(ct.geometry(), a.markers);
  Task task{imaging::crop(ct.view(), box), imaging::crop(markers.view(), box), box.low,
            static_cast<RegionLabel>(a.outside)};
  if (std::all_of(task.markers.values().begin(), task.markers.values().end(),
                  [](RegionLabel m) { return m == 0; })) {
    throw InvalidInput(a.markers.string() + ": holds no marker in the region that is asked for");
  }
  if (a.outside == 0) {
    warn("no marker stands for what is no bone (--outside N), so that bones are flooded into it");
  }
  return task;
}

Grid<std::uint8_t> on_the_scan(const GridGeometry& g, const Labels& part, const VoxelIndex& at) {
  Grid<std::uint8_t> whole(g);
  for (std::size_t i = 0; i < part.values().size(); ++i) {
    if (part[i] == 0) continue;
    const VoxelIndex v = part.geometry().index_of(i);
    whole[VoxelIndex{v.x + at.x, v.y + at.y, v.z + at.z}] = static_cast<std::uint8_t>(part[i]);
  }
  return whole;
}

void require_room_for_labels(const Labels& markers) {
  const RegionLabel most = *std::max_element(markers.values().begin(), markers.values().end());
  if (most <= kMostLabel) return;
  throw InvalidInput("there are " + std::to_string(most - 1) +
                     " bodies as dense as bone, more than a label volume holds (255); give a "
                     "--region, or --markers");
}

struct LabelFigures {
  std::size_t marker_voxels = 0;
  std::size_t voxels = 0;
};

nlohmann::ordered_json report(const Arguments& a,
                              const Task& task,
                              const Labels& flooded,
                              const reconstruct::StageClock& clock) {
  std::vector<LabelFigures> of_label(std::size_t{kMostLabel} + 1);
  for (std::size_t i = 0; i < flooded.values().size(); ++i) {
    ++of_label[flooded[i]].voxels;
    ++of_label[task.markers[i]].marker_voxels;
  }
  const double voxel_mm3 = flooded.geometry().voxel_volume_mm3();
  nlohmann::ordered_json json;
  json["flooded_in"] = a.slices ? "slices" : "volume";
  json["neighbours"] = a.neighbours == 0 ? (a.slices ? 4 : 6) : a.neighbours;
  json["gradient_sigma_mm"] = a.sigma_mm;
  // Voxels that no basin holds: between basins with --dams, beyond all markers without.
  json["unlabelled_voxels"] = of_label[0].voxels;
  json["labels"] = nlohmann::json::array();
  std::printf("%-8s %14s %14s %14s\n", "label", "marker voxels", "voxels", "mm3");
  for (std::size_t label = 1; label < of_label.size(); ++label) {
    if (of_label[label].voxels == 0) continue;
    const double mm3 = static_cast<double>(of_label[label].voxels) * voxel_mm3;
    const bool is_outside = label == task.outside;
    std::printf("%-8s %14zu %14zu %14.1f\n", is_outside ? "outside" : std::to_string(label).c_str(),
                of_label[label].marker_voxels, of_label[label].voxels, mm3);
    if (is_outside) continue;
    json["labels"].push_back({{"label", label},
                              {"marker_voxels", of_label[label].marker_voxels},
                              {"voxels", of_label[label].voxels},
                              {"volume_mm3", mm3}});
  }
  std::printf("%-8s %14s %14zu\n", "none", "", of_label[0].voxels);
  for (const auto& stage : clock.stages()) {
    std::printf("%-24s %8.2f s\n", stage.name.c_str(), stage.seconds);
    json["seconds"][stage.name] = stage.seconds;
  }
  return json;
}

/// One closed surface a label, half-way between voxels: for a look in another program, not for a
/// case, whose surfaces follow the grey values (reconstruct).
void write_surfaces(const fs::path& folder,
                    const Labels& labels,
                    const GridView<const std::int16_t>& ct) {
  std::error_code failed;
  fs::create_directories(folder, failed);  // what fails is said by the first write
  for (const mesh::LabelSurface& surface : mesh::extract_label_surfaces(labels.view())) {
    const fs::path file = folder / ("label_" + std::to_string(surface.label) + ".ply");
    const std::vector<Vec3> normals = case_io::bone_normals(surface.mesh, {}, ct);
    records::write_file_atomically(file, [&](const fs::path& temporary) {
      case_io::write_surface(temporary, surface.mesh, normals);
    });
  }
}

void check_targets(const Arguments& a) {
  if (a.out == a.markers_out) {
    throw UsageError("--write-markers: names the file of the labels; give another");
  }
  for (const fs::path& file : {a.out, a.markers_out}) {
    if (file.empty()) continue;
    case_io::require_volume_name(file);
    if (!fs::exists(file) || a.force) continue;
    throw IoError(file.string() + ": exists; give another file or --force to replace it");
  }
}

/// Before minutes of work, and before anything is written.
void require_slice(int slice, const Task& task) {
  const int first = task.offset.z;
  const int last = first + task.markers.geometry().size[2] - 1;
  if (slice >= first && slice <= last) return;
  throw UsageError("--slice: give one from " + std::to_string(first) + " to " +
                   std::to_string(last));
}

void run(const Arguments& a) {
  imaging::WatershedOptions options;
  options.space = a.slices ? imaging::FloodSpace::Slices : imaging::FloodSpace::Volume;
  options.connectivity = connectivity_of(a);
  options.keep_dams = a.dams;
  options.progress = [](std::string_view stage, double fraction) {
    StopRequest::show_or_stop(stage, 0.7 + 0.25 * fraction);
  };
  if (a.outside != 0 && a.markers.empty()) {
    throw UsageError("--outside: markers that are found have one of their own; give --markers");
  }
  check_targets(a);
  const StopRequest stop;
  reconstruct::StageClock clock;
  clock.begin("read");
  StopRequest::show_or_stop("read", 0);
  case_io::ReadOptions reading;
  reading.series_uid = a.series;
  reading.warn = warn;
  const Grid<std::int16_t> ct = case_io::read_ct(a.input, reading);
  clock.begin("markers");
  const GridGeometry& g = ct.geometry();
  const VoxelBox box = a.region.empty() ? whole_of(g) : box_between(g, a.region);
  Task task = a.markers.empty() ? find_markers(imaging::crop(ct.view(), box), box.low, a)
                                : take_markers(ct, box, a);
  if (a.slice >= 0) require_slice(a.slice, task);
  require_room_for_labels(task.markers);
  clock.begin("gradient");
  StopRequest::show_or_stop("gradient", 0.6);
  const Grid<float> gradient = imaging::gradient_magnitude(task.hu.view(), a.sigma_mm);
  clock.begin("watershed");
  Labels flooded = task.markers;
  imaging::flood_from_markers(gradient.view(), {}, options, flooded.view());
  clock.end();
  StopRequest::show_or_stop("write", 0.95);

  const nlohmann::ordered_json figures = report(a, task, flooded, clock);
  if (task.outside != 0) {
    for (RegionLabel& label : flooded.values()) label = label == task.outside ? 0 : label;
  }
  const std::string about = is_simulated_scan(a.input, a.series)
                                ? "simulated; labels by carpus segment"
                                : "labels by carpus segment";
  const auto write = [&](const fs::path& file, const Labels& labels) {
    const Grid<std::uint8_t> whole = on_the_scan(g, labels, task.offset);
    records::write_file_atomically(file, [&](const fs::path& temporary) {
      case_io::write_volume<std::uint8_t>(temporary, whole.view(), about);
    });
  };
  write(a.out, flooded);
  if (!a.markers_out.empty()) write(a.markers_out, task.markers);
  if (!a.surfaces.empty()) write_surfaces(a.surfaces, flooded, ct.view());
  if (!a.json.empty()) records::write_file_atomically(a.json, figures.dump(2) + "\n");
  if (!a.pictures.empty()) {
    const VoxelBox part{task.offset,
                        {task.offset.x + flooded.geometry().size[0] - 1,
                         task.offset.y + flooded.geometry().size[1] - 1,
                         task.offset.z + flooded.geometry().size[2] - 1}};
    const Grid<std::int16_t> grey = imaging::crop(ct.view(), part);
    const int z =
        a.slice >= 0 ? a.slice - task.offset.z : figures::most_telling_slice(flooded.view());
    const figures::SegmentSteps steps{grey.view(), gradient.view(),
                                      std::as_const(task.markers).view(),
                                      std::as_const(flooded).view(), task.outside};
    figures::write_segment_pictures(a.pictures, steps, z);
    std::printf("pictures: %s (slice %d)\n", a.pictures.string().c_str(), z + task.offset.z);
  }
  std::printf("labels: %s\n", a.out.string().c_str());
}

}  // namespace

void add_segment_command(CLI::App& app) {
  auto a = std::make_shared<Arguments>();
  CLI::App* command =
      app.add_subcommand("segment", "Part a CT into bodies by a watershed from markers");
  command
      ->add_option(
          "input", a->input,
          "CT: a folder with one DICOM series, or a .nii, .nii.gz, .nrrd, .mha or .dcm file")
      ->required();
  command->add_option("--out", a->out, "Label volume to write (.nii.gz, .nrrd, .mha)")->required();
  command->add_option("--markers", a->markers,
                      "Label volume on the CT's grid, or a .csv of label,x,y,z,radius in mm of the "
                      "patient (LPS); found by cortex and joint clefts where not given");
  command->add_option("--outside", a->outside, "The markers' label of what is no bone; becomes 0")
      ->check(CLI::Range(1, 255));
  command->add_option("--write-markers", a->markers_out,
                      "Write the markers too, to be mended and given again");
  command->add_flag("--slices", a->slices, "Flood each axial slice for itself, as the thesis does");
  command->add_option("--neighbours", a->neighbours,
                      "Of a voxel: 6, 18 or 26 (6 if not given), with --slices 4 or 8 (4)");
  command->add_flag("--dams", a->dams, "Leave a wall of label 0 where basins meet");
  command
      ->add_option("--region", a->region,
                   "Flood only between two corners: x,y,z,x,y,z in mm of the patient (LPS)")
      ->expected(6)
      ->delimiter(',');
  command->add_option("--sigma", a->sigma_mm, "Width of the gradient's Gaussian [mm]")
      ->check(CLI::Range(0.0, 10.0))
      ->capture_default_str();
  command->add_option("--pictures", a->pictures,
                      "Folder for pictures of the steps: CT, gradient with markers, basins, bones");
  command->add_option("--surfaces", a->surfaces,
                      "Folder for each label's surface, label_N.ply, half-way between voxels");
  command->add_option("--slice", a->slice, "Slice of the pictures; the one that shows most else");
  command->add_option("--series", a->series, "SeriesInstanceUID, where a folder holds several");
  command->add_option("--json", a->json, "Write the figures to this file");
  command->add_flag("--force", a->force, "Replace label volumes that exist");
  command->callback([a] { run(*a); });
}

}  // namespace carpus::cli
