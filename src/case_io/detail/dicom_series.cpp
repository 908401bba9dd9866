// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// 1. Every file with the DICM mark is opened up to its pixels (GDCM); images are kept. A file
// without
//    it that is empty, or named like DICOM or like a slice found, is damaged.
// 2. They are grouped by SeriesInstanceUID.
// 3. Slices are sorted along the normal of their plane; place decides, never the file's name or
//    InstanceNumber, which exporters renumber.
// 4. Equal steps are proved before any pixel is read: a missing slice would bend every bone.
// 5. Pixels come through itk::GDCMImageIO, which decompresses and applies slope and intercept.
#include "case_io/detail/dicom_series.hpp"

#include <gdcmReader.h>
#include <gdcmStringFilter.h>
#include <gdcmTag.h>
#include <gdcmTrace.h>
#include <itkGDCMImageIO.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <fstream>
#include <map>
#include <set>

#include "case_io/detail/dicom_structure.hpp"
#include "core/error.hpp"

namespace carpus::case_io {
namespace fs = std::filesystem;
namespace {

/// Steps between slices may differ by rounding of positions to 0.01 mm, or by 2 % of a step.
constexpr double kStepToleranceMm = 0.02;
constexpr double kStepToleranceRatio = 0.02;
/// Orientation cosines and pixel spacings of one series agree to their written digits.
constexpr double kSameDirectionTolerance = 1e-3;
/// Sideways drift from slice to slice per mm of step: tan of half a degree of gantry tilt.
constexpr double kTiltTolerance = 0.009;

std::string trimmed(std::string s) {
  const auto is_padding = [](char c) { return c == ' ' || c == '\0'; };
  while (!s.empty() && is_padding(s.back())) s.pop_back();
  s.erase(s.begin(), std::find_if_not(s.begin(), s.end(), is_padding));
  return s;
}

/// Numbers of a backslash-separated value; empty where one is not a number.
std::vector<double> numbers_of(const std::string& value) {
  std::vector<double> numbers;
  for (std::size_t begin = 0; begin <= value.size();) {
    const std::size_t end = std::min(value.find('\\', begin), value.size());
    const std::string part = trimmed(value.substr(begin, end - begin));
    const char* first = part.data() + (part.starts_with('+') ? 1 : 0);
    double number = 0;
    const auto [last, error] = std::from_chars(first, part.data() + part.size(), number);
    if (error != std::errc{} || last != part.data() + part.size() || !std::isfinite(number))
      return {};
    numbers.push_back(number);
    begin = end + 1;
  }
  return numbers;
}

class Header {
 public:
  explicit Header(const gdcm::File& file) { filter_.SetFile(file); }
  [[nodiscard]] std::string text(std::uint16_t group, std::uint16_t element) {
    return trimmed(filter_.ToString(gdcm::Tag(group, element)));
  }
  [[nodiscard]] std::vector<double> numbers(std::uint16_t group, std::uint16_t element) {
    return numbers_of(text(group, element));
  }
  [[nodiscard]] int integer(std::uint16_t group, std::uint16_t element, int otherwise) {
    const std::vector<double> n = numbers(group, element);
    return n.size() == 1 && n[0] >= 0 && n[0] <= 65535 * 16 ? static_cast<int>(n[0]) : otherwise;
  }

 private:
  gdcm::StringFilter filter_;
};

void take_place(Header& header, DicomSlice& slice) {
  const std::vector<double> position = header.numbers(0x0020, 0x0032);
  const std::vector<double> axes = header.numbers(0x0020, 0x0037);
  const std::vector<double> spacing = header.numbers(0x0028, 0x0030);
  slice.has_place = position.size() == 3 && axes.size() == 6 && spacing.size() == 2;
  if (!slice.has_place) return;
  slice.position = {position[0], position[1], position[2]};
  slice.row = {axes[0], axes[1], axes[2]};
  slice.column = {axes[3], axes[4], axes[5]};
  slice.spacing = {spacing[1], spacing[0], 0};  // PixelSpacing is row distance first
}

[[noreturn]] void throw_damaged(const fs::path& file) {
  throw IoError(file.string() +
                ": its DICOM header is damaged; copy the file again from its source");
}

[[noreturn]] void throw_cut_short(const fs::path& file) {
  throw IoError(
      file.string() +
      ": is cut short (its DICOM elements run past its end); copy the file again from its "
      "source");
}

/// True where the file is a DICOM image; false where it is DICOM but no image.
bool scan_file(const fs::path& file, DicomSlice& slice) {
  const DicomCheck check = check_dicom_structure(file);
  if (check.structure == DicomStructure::CutShort) throw_cut_short(file);
  if (check.structure == DicomStructure::Damaged) throw_damaged(file);
  gdcm::Reader reader;
  reader.SetFileName(file.string().c_str());
  if (!reader.ReadUpToTag(gdcm::Tag(0x7fe0, 0x0000))) {
    throw IoError(
        file.string() +
        ": its DICOM header is damaged or cut short; copy the file again from its source");
  }
  Header header(reader.GetFile());
  slice.file = file;
  slice.columns = header.integer(0x0028, 0x0011, 0);
  slice.rows = header.integer(0x0028, 0x0010, 0);
  if (slice.columns == 0 || slice.rows == 0) return false;
  if (check.structure == DicomStructure::Whole && !check.has_pixels) throw_cut_short(file);
  const int samples = header.integer(0x0028, 0x0002, 1);
  if (samples != 1 && samples != 3 && samples != 4) throw_damaged(file);  // GDCM aborts on others
  slice.frames = header.integer(0x0028, 0x0008, 1);
  slice.series_uid = header.text(0x0020, 0x000e);
  slice.series_description = header.text(0x0008, 0x103e);
  slice.modality = header.text(0x0008, 0x0060);
  slice.instance_uid = header.text(0x0008, 0x0018);
  take_place(header, slice);
  return true;
}

std::vector<fs::path> files_under(const fs::path& folder) {
  std::vector<fs::path> files;
  try {
    for (const auto& entry : fs::recursive_directory_iterator(
             folder, fs::directory_options::follow_directory_symlink)) {
      if (entry.is_regular_file()) files.push_back(entry.path());
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

std::string slice_text(const DicomSlice& s) { return s.file.filename().string(); }

std::string mm(double v) {
  std::array<char, 32> buffer{};
  const int n = std::snprintf(buffer.data(), buffer.size(), "%.3g mm", v);
  return std::string(buffer.data(), static_cast<std::size_t>(std::max(n, 0)));
}

void check_alike(const std::vector<DicomSlice>& slices) {
  const DicomSlice& first = slices.front();
  for (const DicomSlice& s : slices) {
    if (!s.has_place) {
      throw InvalidInput(s.file.string() +
                         ": has no ImagePositionPatient, ImageOrientationPatient or PixelSpacing, "
                         "so its place is unknown; export the series again with its geometry");
    }
    if (s.columns != first.columns || s.rows != first.rows ||
        !(distance(s.spacing, first.spacing) < kSameDirectionTolerance)) {
      throw InvalidInput(s.file.string() + ": differs in size or pixel spacing from " +
                         slice_text(first) +
                         " of the same series; move what does not belong to the scan elsewhere");
    }
    if (!(distance(s.row, first.row) < kSameDirectionTolerance &&
          distance(s.column, first.column) < kSameDirectionTolerance)) {
      throw InvalidInput(s.file.string() + ": lies in another plane than " + slice_text(first) +
                         " of the same series; move what does not belong to the scan elsewhere");
    }
  }
}

/// Proves equal steps along the normal and returns the step [mm]; slices are sorted.
double check_steps(const std::vector<DicomSlice>& slices, const Vec3& normal) {
  std::vector<double> steps;
  for (std::size_t i = 1; i < slices.size(); ++i) {
    const Vec3 move = slices[i].position - slices[i - 1].position;
    const double step = dot(move, normal);
    if (step < kStepToleranceMm) {
      const bool is_copy = slices[i].instance_uid == slices[i - 1].instance_uid;
      throw InvalidInput(slices[i].file.string() + " and " + slice_text(slices[i - 1]) +
                         (is_copy ? ": are the same slice twice; remove one copy"
                                  : ": lie at the same place; two scans share a series: separate "
                                    "them into two folders"));
    }
    if (length(move - normal * step) > kTiltTolerance * step + kStepToleranceMm) {
      throw InvalidInput(
          slices[i].file.string() +
          ": the slices are shifted sideways (tilted gantry); resample the series to "
          "a rectangular grid, for example in 3D Slicer, and open the result");
    }
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
    throw InvalidInput(slices[i].file.parent_path().string() + ": between " +
                       slice_text(slices[i]) + " and " + slice_text(slices[i + 1]) + " lie " +
                       mm(steps[i]) + " where other slices are " + mm(usual) + " apart: " +
                       (is_gap ? std::to_string(std::lround(missing)) +
                                     " slice(s) missing; export the whole series again"
                               : "the spacing is uneven; resample the series to even slices"));
  }
  const Vec3 whole = slices.back().position - slices.front().position;
  return dot(whole, normal) / static_cast<double>(slices.size() - 1);
}

Grid<std::int16_t> read_single_file(const DicomSlice& slice, ValueCount& count) {
  auto io = itk::GDCMImageIO::New();
  const GridGeometry geometry = read_geometry(*io, slice.file);
  Grid<std::int16_t> grid(geometry);
  read_values<std::int16_t>(*io, slice.file, grid.values(), count);
  return grid;
}

}  // namespace

bool looks_like_dicom(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::array<char, 132> start{};
  in.read(start.data(), start.size());
  return in.gcount() == static_cast<std::streamsize>(start.size()) && start[128] == 'D' &&
         start[129] == 'I' && start[130] == 'C' && start[131] == 'M';
}

std::vector<DicomSeries> scan_dicom(const fs::path& folder) {
  gdcm::Trace::WarningOff();
  gdcm::Trace::ErrorOff();  // our messages name the file and what to do
  std::map<std::string, DicomSeries> by_uid;
  std::vector<fs::path> unmarked;
  std::set<std::string> patterns;
  for (const fs::path& file : files_under(folder)) {
    if (file.filename() == "DICOMDIR") continue;
    if (!looks_like_dicom(file)) {
      unmarked.push_back(file);
      continue;
    }
    DicomSlice slice;
    if (!scan_file(file, slice)) continue;
    patterns.insert(name_pattern(file));
    DicomSeries& series = by_uid[slice.series_uid];
    if (series.slices.empty()) {
      series.summary = {slice.series_uid, slice.series_description, slice.modality, 0,
                        file.parent_path()};
    }
    series.summary.slices += slice.frames;
    series.slices.push_back(std::move(slice));
  }
  refuse_lost_slices(unmarked, patterns);
  std::vector<DicomSeries> all;
  for (auto& [uid, series] : by_uid) all.push_back(std::move(series));
  std::stable_sort(all.begin(), all.end(), [](const DicomSeries& a, const DicomSeries& b) {
    return a.summary.slices > b.summary.slices;
  });
  return all;
}

Grid<std::int16_t> read_series(DicomSeries series, const Progress& progress, ValueCount& count) {
  std::vector<DicomSlice>& slices = series.slices;
  if (slices.size() == 1) return read_single_file(slices.front(), count);
  check_alike(slices);
  const DicomSlice& any = slices.front();
  const Vec3 normal = normalized_or(cross(any.row, any.column), {0, 0, 1});
  std::stable_sort(slices.begin(), slices.end(), [&](const DicomSlice& a, const DicomSlice& b) {
    return dot(a.position, normal) < dot(b.position, normal);
  });
  const double step = check_steps(slices, normal);

  auto io = itk::GDCMImageIO::New();
  GridGeometry g = read_geometry(*io, slices.front().file);
  g.size[2] = static_cast<int>(slices.size());
  g.spacing.z = step;
  g.origin = slices.front().position;
  if (g.voxel_count() > kMostVoxels) {
    throw InvalidInput(any.file.parent_path().string() +
                       ": the series has more voxels than this program holds (2^30); crop it");
  }
  Grid<std::int16_t> grid(g);
  const std::size_t slice_size =
      static_cast<std::size_t>(g.size[0]) * static_cast<std::size_t>(g.size[1]);
  for (std::size_t k = 0; k < slices.size(); ++k) {
    const auto slice_io = itk::GDCMImageIO::New();
    const GridGeometry own = read_geometry(*slice_io, slices[k].file);
    if (own.size[0] != g.size[0] || own.size[1] != g.size[1] || own.size[2] != 1) {
      throw InvalidInput(slices[k].file.string() + ": has another size than the first slice");
    }
    read_values<std::int16_t>(*slice_io, slices[k].file,
                              grid.values().subspan(k * slice_size, slice_size), count);
    progress("reading", static_cast<double>(k + 1) / static_cast<double>(slices.size()));
  }
  return grid;
}

}  // namespace carpus::case_io
