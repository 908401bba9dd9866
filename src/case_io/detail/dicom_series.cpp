// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// 1. Every file with the DICM mark is parsed (image_formats), its pixels passed over; images are
//    kept. A file without it that is empty, or named like DICOM or like a slice found, is damaged.
// 2. They are grouped by SeriesInstanceUID.
// 3. Slices are sorted along the normal of their plane; place decides, never the file's name or
//    InstanceNumber, which exporters renumber.
// 4. Equal steps and equal pixels are proved before any pixel is read: a missing slice would bend
//    every bone.
// 5. A child process decodes the pixels and applies slope and intercept.
// 6. Slices of a tilted gantry, which begin evenly beside each other, are set upright.
#include "case_io/detail/dicom_series.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <map>
#include <set>

#include "case_io/detail/dicom_pixels.hpp"
#include "case_io/detail/disposable_child.hpp"
#include "case_io/detail/memory_room.hpp"
#include "case_io/detail/regular_file.hpp"
#include "case_io/detail/shared_array.hpp"
#include "case_io/detail/unpacking.hpp"
#include "case_io/detail/upright_slices.hpp"
#include "core/error.hpp"
#include "core/units.hpp"

namespace carpus::case_io {
namespace fs = std::filesystem;
namespace {

using image_formats::DicomFrame;
using image_formats::DicomHeader;
using image_formats::Refuser;

/// Steps between slices may differ by rounding of positions to 0.01 mm, or by 2 % of a step.
constexpr double kStepToleranceMm = 0.02;
constexpr double kStepToleranceRatio = 0.02;
/// Orientation cosines of one series agree to their written digits, pixel spacings exactly but for
/// how they are written [mm].
constexpr double kSameDirectionTolerance = 1e-4;
constexpr double kSameSpacingMm = 1e-6;
/// Sideways drift from slice to slice per mm of step: tan of half a degree of gantry tilt.
constexpr double kTiltTolerance = 0.009;
/// Sideways, of a step: gantries tilt by up to 30 degrees.
constexpr double kMostTilt = 0.6;
/// A deflated data set of more is refused: a slice takes 2 MB, and nothing says beforehand what
/// comes out.
constexpr std::uint64_t kMostUnpackedBytes = std::uint64_t{256} << 20U;

/// A link may lead out of the folder and back; far beyond any scan.
constexpr int kDeepestFolder = 16;
constexpr std::size_t kMostFiles = 100000;

/// True where the file is a DICOM image; false where it is DICOM but no image.
bool scan_file(const RegularFile& file, FileBytes& bytes, DicomSlice& slice) {
  const Refuser refuse(file.path().string());
  const image_formats::DicomFront front = image_formats::parse_dicom_front(bytes, refuse);
  slice.file = file.path();
  slice.file_bytes = file.size();
  slice.class_uid = front.class_uid;
  if (!front.syntax.is_deflated) {
    slice.header = image_formats::parse_dicom(bytes, front.data_begins, front.syntax, refuse);
    return slice.header.is_image;
  }
  const std::uint64_t packed_bytes = file.size() - front.data_begins;
  require_memory(std::min(packed_bytes, kMostUnpackedBytes) + kMostUnpackedBytes, refuse.file());
  if (packed_bytes > kMostUnpackedBytes) {
    refuse.damaged("its deflated data set", std::to_string(packed_bytes) + " bytes",
                   "more than a slice needs");
  }
  std::vector<std::byte> packed(static_cast<std::size_t>(packed_bytes));
  if (!bytes.read(front.data_begins, packed)) {
    refuse.damaged("the file", "not readable", "check the disk");
  }
  const std::vector<std::byte> unpacked = unpack_deflated(packed, kMostUnpackedBytes, refuse);
  slice.data_begins = front.data_begins;
  slice.unpacked_bytes = unpacked.size();
  image_formats::MemoryBytes data(unpacked);
  slice.header = image_formats::parse_dicom(data, 0, front.syntax, refuse);
  return slice.header.is_image;
}

std::vector<fs::path> files_under(const fs::path& folder) {
  std::vector<fs::path> files;
  try {
    fs::recursive_directory_iterator at(folder, fs::directory_options::follow_directory_symlink);
    for (; at != fs::recursive_directory_iterator(); ++at) {
      if (at->is_regular_file()) files.push_back(at->path());
      if (at.depth() > kDeepestFolder || files.size() > kMostFiles) {
        throw IoError(folder.string() + ": holds more than " + std::to_string(kMostFiles) +
                      " files, or folders in folders without end; give the scan's own folder");
      }
    }
  } catch (const fs::filesystem_error& error) {
    throw IoError(folder.string() + ": cannot be searched (" + error.code().message() +
                  "); check that the folder and all in it may be read");
  }
  std::sort(files.begin(), files.end());
  return files;
}

/// "IM_0001.dcm" and "IM_0172.dcm": "IM_#.dcm".
std::string name_pattern(const fs::path& file) {
  std::string pattern;
  for (const char c : file.filename().string()) {
    const bool is_digit = c >= '0' && c <= '9';
    if (!is_digit) pattern += c;
    if (is_digit && !pattern.ends_with('#')) pattern += '#';
  }
  return pattern;
}

/// A slice that was cut before its mark would go unnoticed at either end of a series.
void refuse_lost_slices(const std::vector<fs::path>& unmarked,
                        const std::set<std::string>& patterns) {
  for (const fs::path& file : unmarked) {
    std::string extension = file.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    const std::string pattern = name_pattern(file);
    const bool is_of_series = pattern.find('#') != std::string::npos && patterns.contains(pattern);
    if (extension != ".dcm" && extension != ".ima" && !is_of_series) continue;
    std::error_code error;
    const bool is_empty = fs::file_size(file, error) == 0 && !error;
    throw IoError(
        file.string() + (is_empty ? ": is empty" : ": is no DICOM file, or cut short") +
        "; copy the file again from its source, or remove it if it is no part of the scan");
  }
}

/// A file of the same kind as the slices found but without an image was cut off between two
/// elements.
void refuse_headless(const std::map<fs::path, std::string>& class_of_others,
                     const std::map<std::string, DicomSeries>& by_uid) {
  for (const auto& [file, class_uid] : class_of_others) {
    for (const auto& [uid, series] : by_uid) {
      if (class_uid.empty() || series.slices.front().class_uid != class_uid) continue;
      throw IoError(file.string() +
                    ": holds no image, though it is of the kind that does, so it is cut short; "
                    "copy the file again from its source");
    }
  }
}

std::string mm(double v) {
  std::array<char, 32> buffer{};
  const int n = std::snprintf(buffer.data(), buffer.size(), "%.3g mm", v);
  return std::string(buffer.data(), static_cast<std::size_t>(std::max(n, 0)));
}

/// One picture of a series: a file's only one, or one of its frames.
struct Plane {
  const DicomSlice* slice = nullptr;
  std::size_t frame = 0;

  [[nodiscard]] const DicomFrame& at() const { return slice->header.frames[frame]; }
  [[nodiscard]] std::string name() const {
    const std::string file = slice->file.filename().string();
    return slice->header.frames.size() == 1 ? file : file + ", frame " + std::to_string(frame + 1);
  }
  [[nodiscard]] std::string path() const { return slice->file.string(); }
};

/// For a list, before anything is known to be right: the mean step, as if none were missing.
Vec3 spacing_in(const DicomSeries& series) {
  const DicomFrame& first = series.slices.front().header.frames.front();
  if (!first.has_place) return {};
  const Vec3 normal = cross(first.row, first.column);
  double low = 0;
  double high = 0;
  for (const DicomSlice& slice : series.slices) {
    for (const DicomFrame& frame : slice.header.frames) {
      const double place = frame.has_place ? dot(frame.position - first.position, normal) : 0;
      low = std::min(low, place);
      high = std::max(high, place);
    }
  }
  return {first.spacing.x, first.spacing.y, (high - low) / std::max(1, series.summary.slices - 1)};
}

std::vector<Plane> planes_of(const DicomSeries& series) {
  std::vector<Plane> planes;
  for (const DicomSlice& slice : series.slices) {
    image_formats::check_readable(slice.header, Refuser(slice.file.string()));
    for (std::size_t i = 0; i < slice.header.frames.size(); ++i) planes.push_back({&slice, i});
  }
  return planes;
}

constexpr const char* kMoveElsewhere =
    " of the same series; move what does not belong to the scan elsewhere";

void check_same_pixels(const Plane& plane, const Plane& first) {
  const DicomHeader& a = plane.slice->header;
  const DicomHeader& b = first.slice->header;
  const auto differ = [&](const char* what) {
    throw InvalidInput(plane.path() + ": has another " + what + " than " + first.name() +
                       kMoveElsewhere);
  };
  if (a.bits_allocated != b.bits_allocated) differ("BitsAllocated");
  if (a.bits_stored != b.bits_stored) differ("BitsStored");
  if (a.is_signed != b.is_signed) differ("PixelRepresentation");
  if (a.frame_of_reference_uid != b.frame_of_reference_uid) differ("FrameOfReferenceUID");
  if (plane.at().has_rescale != first.at().has_rescale) differ("rescale");
  if (plane.at().slope != first.at().slope) differ("RescaleSlope");
  if (plane.at().intercept != first.at().intercept) differ("RescaleIntercept");
}

void check_alike(const std::vector<Plane>& planes) {
  const Plane& first = planes.front();
  for (const Plane& p : planes) {
    if (!p.at().has_place) {
      throw InvalidInput(p.path() +
                         ": has no ImagePositionPatient, ImageOrientationPatient or PixelSpacing, "
                         "so its place is unknown; export the series again with its geometry");
    }
    if (p.slice->header.columns != first.slice->header.columns ||
        p.slice->header.rows != first.slice->header.rows ||
        !(distance(p.at().spacing, first.at().spacing) < kSameSpacingMm)) {
      throw InvalidInput(p.path() + ": differs in size or pixel spacing from " + first.name() +
                         kMoveElsewhere);
    }
    if (!(distance(p.at().row, first.at().row) < kSameDirectionTolerance &&
          distance(p.at().column, first.at().column) < kSameDirectionTolerance)) {
      throw InvalidInput(p.path() + ": lies in another plane than " + first.name() +
                         kMoveElsewhere);
    }
    check_same_pixels(p, first);
  }
}

/// From one slice to the next.
struct SliceStep {
  double along = 0;  ///< the normal [mm]
  Vec3 aside;        ///< across it, of a tilted gantry [mm]; else 0
};

/// Proves equal steps; planes are sorted.
SliceStep check_steps(const std::vector<Plane>& planes, const Vec3& normal, ReadingNotes& notes) {
  const Vec3 whole = planes.back().at().position - planes.front().at().position;
  const auto count = static_cast<double>(planes.size() - 1);
  const Vec3 aside = (whole - normal * dot(whole, normal)) / count;
  bool is_tilted = false;
  std::vector<double> steps;
  for (std::size_t i = 1; i < planes.size(); ++i) {
    const Vec3 move = planes[i].at().position - planes[i - 1].at().position;
    const double step = dot(move, normal);
    if (!(step >= kStepToleranceMm)) {
      const bool is_copy =
          planes[i].slice->header.instance_uid == planes[i - 1].slice->header.instance_uid &&
          planes[i].slice != planes[i - 1].slice;
      throw InvalidInput(planes[i].path() + " and " + planes[i - 1].name() +
                         (is_copy ? ": are the same slice twice; remove one copy"
                                  : ": lie at the same place; two scans share a series: separate "
                                    "them into two folders"));
    }
    const double tolerance = kTiltTolerance * step + kStepToleranceMm;
    const Vec3 across = move - normal * step;
    if (!(length(across - aside) <= tolerance && length(across) <= kMostTilt * step)) {
      throw InvalidInput(
          planes[i].path() +
          ": the slices are shifted sideways, farther or less evenly than by a tilted gantry; "
          "resample the series to a rectangular grid, for example in 3D Slicer, and open the "
          "result");
    }
    is_tilted = is_tilted || length(across) > tolerance;
    steps.push_back(step);
  }
  std::vector<double> sorted = steps;
  std::sort(sorted.begin(), sorted.end());
  const double usual = sorted[sorted.size() / 2];
  const double tolerance = std::max(kStepToleranceMm, kStepToleranceRatio * usual);
  for (std::size_t i = 0; i < steps.size(); ++i) {
    if (std::abs(steps[i] - usual) <= tolerance) continue;
    const double missing = steps[i] / usual - 1.0;
    const bool is_gap = missing > 0.5 && std::abs(missing - std::round(missing)) < 0.1;
    throw InvalidInput(planes[i].slice->file.parent_path().string() + ": between " +
                       planes[i].name() + " and " + planes[i + 1].name() + " lie " + mm(steps[i]) +
                       " where other slices are " + mm(usual) + " apart: " +
                       (is_gap ? std::to_string(std::lround(missing)) +
                                     " slice(s) missing; export the whole series again"
                               : "the spacing is uneven; resample the series to even slices"));
  }
  constexpr double kWrittenDigitsMm = 1e-4;
  if (sorted.back() - sorted.front() > kWrittenDigitsMm) {
    notes.conventions.push_back("slices " + mm(sorted.front()) + " to " + mm(sorted.back()) +
                                " apart were taken as even");
  }
  const double along = dot(whole, normal) / count;
  if (!is_tilted) return {along, {}};
  notes.conventions.push_back(
      "slices begin " + mm(length(aside)) + " beside each other (gantry tilted by " +
      image_formats::printable(std::round(degrees_from_radians(std::atan2(length(aside), along)))) +
      " degrees): they were set upright, values between pixels interpolated");
  return {along, aside};
}

GridGeometry geometry_of(const std::vector<Plane>& planes, const Vec3& normal, double step) {
  const Plane& first = planes.front();
  image_formats::StatedGeometry stated;
  stated.size = {static_cast<double>(first.slice->header.columns),
                 static_cast<double>(first.slice->header.rows), static_cast<double>(planes.size())};
  stated.spacing = first.at().spacing;
  stated.spacing.z = step;
  stated.origin = first.at().position;
  stated.axes = {first.at().row, first.at().column, normal};
  return image_formats::usable_geometry(stated, Refuser(first.path()));
}

/// Of one kind and size, in one plane as far as is known.
bool are_alike(const Plane& a, const Plane& b) {
  const DicomHeader& x = a.slice->header;
  const DicomHeader& y = b.slice->header;
  if (x.columns != y.columns || x.rows != y.rows || a.slice->class_uid != b.slice->class_uid)
    return false;
  if (!a.at().has_place) return true;
  return distance(a.at().spacing, b.at().spacing) < kSameSpacingMm &&
         distance(a.at().row, b.at().row) < kSameDirectionTolerance &&
         distance(a.at().column, b.at().column) < kSameDirectionTolerance;
}

/// A picture that was passed over but is like the slices and lies exactly one step beyond an end,
/// or does not know where it lies: a slice whose SeriesInstanceUID was changed would be lost
/// unseen.
void refuse_strays(const std::vector<DicomSlice>& strays,
                   const std::vector<Plane>& planes,
                   const Vec3& move) {
  const Plane& first = planes.front();
  const Plane& last = planes.back();
  for (const DicomSlice& slice : strays) {
    for (std::size_t i = 0; i < slice.header.frames.size(); ++i) {
      const Plane p{&slice, i};
      if (!are_alike(p, first)) continue;
      const double before = distance(p.at().position + move, first.at().position);
      const double behind = distance(p.at().position - move, last.at().position);
      if (p.at().has_place && !(std::min(before, behind) < kStepToleranceMm)) continue;
      throw InvalidInput(p.path() + ": is like the slices of the series of " + first.name() +
                         " but names another SeriesInstanceUID; one of the two is damaged, or move "
                         "what does not belong to the scan elsewhere");
    }
  }
}

void note_conventions(const std::vector<Plane>& planes, bool was_sorted, ReadingNotes& notes) {
  const DicomFrame& frame = planes.front().at();
  if (!was_sorted) {
    notes.conventions.push_back(std::to_string(planes.size()) +
                                " slices were sorted by their place, not by their files' names");
  }
  if (!frame.has_rescale) {
    notes.conventions.emplace_back(
        "stored values were taken for HU (no RescaleSlope and RescaleIntercept)");
  } else if (frame.slope != 1 || frame.intercept != 0) {
    notes.conventions.push_back("values are stored x " + image_formats::printable(frame.slope) +
                                " + " + image_formats::printable(frame.intercept) +
                                " (RescaleSlope, RescaleIntercept)");
  }
  if (planes.front().slice->header.syntax.is_lossy) {
    notes.conventions.emplace_back("the pixels were compressed with loss");
  }
}

/// The bytes that a slice's ranges count in; \`unpacked\` holds those of a deflated one.
std::span<const std::byte> data_of(const DicomSlice& slice,
                                   const MappedFile& mapped,
                                   std::vector<std::byte>& unpacked) {
  if (slice.unpacked_bytes == 0) return mapped.bytes();
  unpacked = unpack_deflated(mapped.bytes().subspan(static_cast<std::size_t>(slice.data_begins)),
                             slice.unpacked_bytes, Refuser(slice.file.string()));
  return unpacked;
}

std::map<const DicomSlice*, MappedFile> map_files(const DicomSeries& series) {
  std::map<const DicomSlice*, MappedFile> mapped;
  for (const DicomSlice& slice : series.slices) {
    const RegularFile file(slice.file);
    if (file.size() != slice.file_bytes) {
      throw IoError(slice.file.string() + ": changed while it was read; try again");
    }
    mapped.emplace(&slice, MappedFile(file));
  }
  return mapped;
}

/// In the child: all planes in their order.
void decode_planes(const std::vector<Plane>& planes,
                   const std::map<const DicomSlice*, MappedFile>& mapped,
                   std::span<std::int16_t> values,
                   ValueCount& count,
                   std::atomic<std::uint64_t>& steps) {
  const std::size_t plane_size = values.size() / planes.size();
  const DicomSlice* at = nullptr;
  std::vector<std::byte> unpacked;
  std::span<const std::byte> data;
  for (std::size_t k = 0; k < planes.size(); ++k) {
    if (planes[k].slice != at) {
      at = planes[k].slice;
      data = data_of(*at, mapped.at(at), unpacked);
    }
    decode_dicom_frame(data, at->header, planes[k].frame,
                       values.subspan(k * plane_size, plane_size), count,
                       Refuser(planes[k].path()));
    ++steps;
  }
}

Grid<std::int16_t> decode(const DicomSeries& series,
                          const std::vector<Plane>& planes,
                          const GridGeometry& geometry,
                          const Progress& progress,
                          ValueCount& count) {
  const DicomHeader& header = planes.front().slice->header;
  std::uint64_t unpacked_bytes = 0;
  for (const DicomSlice& slice : series.slices) {
    unpacked_bytes = std::max(unpacked_bytes, slice.unpacked_bytes);
  }
  const std::size_t voxels = geometry.voxel_count();
  ChildTask task;
  // A deflated data set is there twice while its vector grows.
  task.heap_bytes = decoding_bytes(header) + 3 * unpacked_bytes;
  require_memory(voxels * sizeof(std::int16_t) + task.heap_bytes, planes.front().path());
  const std::map<const DicomSlice*, MappedFile> mapped = map_files(series);
  SharedArray<std::int16_t> values(voxels);
  SharedArray<ValueCount> counted(1);
  task.subject = [&](std::uint64_t steps) {
    return planes[std::min<std::size_t>(steps, planes.size() - 1)].path();
  };
  task.deadline = time_for(voxels * sizeof(std::int16_t));
  task.most_steps = planes.size();
  task.work = [&](std::atomic<std::uint64_t>& steps) {
    ValueCount local;
    decode_planes(planes, mapped, values.values(), local, steps);
    counted.values()[0] = local;
  };
  task.watch = [&](std::uint64_t steps) {
    progress("reading", static_cast<double>(steps) / static_cast<double>(planes.size()));
  };
  run_in_child(task);
  count = counted.values()[0];
  return Grid<std::int16_t>(geometry, values.take());
}

}  // namespace

bool looks_like_dicom(const fs::path& file) {
  const RegularFile opened(file);
  FileBytes bytes(opened);
  return image_formats::has_dicom_mark(bytes);
}

std::vector<DicomSeries> scan_dicom(const fs::path& folder) {
  std::map<std::string, DicomSeries> by_uid;
  std::vector<fs::path> unmarked;
  std::map<fs::path, std::string> class_of_others;
  std::set<std::string> patterns;
  for (const fs::path& file : files_under(folder)) {
    if (file.filename() == "DICOMDIR") continue;
    const RegularFile opened(file);
    FileBytes bytes(opened);
    if (!image_formats::has_dicom_mark(bytes)) {
      unmarked.push_back(file);
      continue;
    }
    DicomSlice slice;
    if (!scan_file(opened, bytes, slice)) {
      class_of_others[file] = slice.class_uid;
      continue;
    }
    patterns.insert(name_pattern(file));
    DicomSeries& series = by_uid[slice.header.series_uid];
    if (series.slices.empty()) {
      series.summary = {slice.header.series_uid, slice.header.series_description,
                        slice.header.modality,   0,
                        file.parent_path(),      {}};
    }
    series.summary.slices += static_cast<int>(slice.header.frames.size());
    series.slices.push_back(std::move(slice));
  }
  refuse_lost_slices(unmarked, patterns);
  refuse_headless(class_of_others, by_uid);
  std::vector<DicomSeries> all;
  for (auto& [uid, series] : by_uid) {
    series.summary.spacing_mm = spacing_in(series);
    all.push_back(std::move(series));
  }
  std::stable_sort(all.begin(), all.end(), [](const DicomSeries& a, const DicomSeries& b) {
    return a.summary.slices > b.summary.slices;
  });
  return all;
}

Grid<std::int16_t> read_series(DicomSeries series, const Progress& progress, ReadingNotes& notes) {
  std::vector<Plane> planes = planes_of(series);
  if (planes.size() < 2) {
    throw InvalidInput(series.slices.front().file.string() +
                       ": is a single slice; give the folder of the whole scan");
  }
  check_alike(planes);
  const Vec3 normal =
      normalized_or(cross(planes.front().at().row, planes.front().at().column), {0, 0, 1});
  const auto is_lower = [&](const Plane& a, const Plane& b) {
    return dot(a.at().position, normal) < dot(b.at().position, normal);
  };
  const bool was_sorted = std::is_sorted(planes.begin(), planes.end(), is_lower);
  std::stable_sort(planes.begin(), planes.end(), is_lower);
  const SliceStep step = check_steps(planes, normal, notes);
  refuse_strays(series.strays, planes, normal * step.along + step.aside);
  note_conventions(planes, was_sorted, notes);
  const GridGeometry geometry = geometry_of(planes, normal, step.along);
  Grid<std::int16_t> ct = decode(series, planes, geometry, progress, notes.count);
  if (squared_length(step.aside) <= 0) return ct;
  const DicomFrame& first = planes.front().at();
  return set_upright(ct,
                     {dot(step.aside, first.row) / geometry.spacing.x,
                      dot(step.aside, first.column) / geometry.spacing.y},
                     planes.front().path());
}

}  // namespace carpus::case_io
