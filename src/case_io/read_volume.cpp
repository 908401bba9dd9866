// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "case_io/read_volume.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "case_io/detail/canonical_axes.hpp"
#include "case_io/detail/dicom_series.hpp"
#include "case_io/detail/volume_file.hpp"
#include "core/error.hpp"
#include "image_formats/refusal.hpp"

namespace carpus::case_io {
namespace fs = std::filesystem;
namespace {

/// A series with fewer images is a scout or a single picture, not a volume.
constexpr int kFewestSlices = 8;
/// Bone begins about here, fat and air end below it [HU].
constexpr double kBoneLikelyAboveHu = 300;
constexpr double kAirLikelyBelowHu = -200;

std::string series_list(const std::vector<DicomSeries>& all) {
  std::string list;
  for (const DicomSeries& s : all) {
    using image_formats::printable;  // a terminal obeys what it is shown
    list += "\n  " + std::to_string(s.summary.slices) + " slices  " +
            (s.summary.modality.empty() ? "?" : printable(s.summary.modality)) + "  \"" +
            printable(s.summary.description) + "\"  in " + s.summary.folder.string() +
            "\n    --series " + printable(s.summary.uid);
  }
  return list;
}

DicomSeries choose_series(std::vector<DicomSeries> all,
                          const fs::path& folder,
                          const ReadOptions& options) {
  if (!options.series_uid.empty()) {
    for (DicomSeries& s : all) {
      if (s.summary.uid == options.series_uid) return std::move(s);
    }
    throw InvalidInput(folder.string() + ": holds no series " + options.series_uid + "; it holds" +
                       series_list(all));
  }
  const auto is_volume = [](const DicomSeries& s) { return s.summary.slices >= kFewestSlices; };
  const auto volumes = std::count_if(all.begin(), all.end(), is_volume);
  if (volumes > 1) {
    std::vector<SeriesSummary> choice;
    for (const DicomSeries& s : all) {
      if (is_volume(s)) choice.push_back(s.summary);
    }
    throw SeveralSeries(
        folder.string() + ": holds " + std::to_string(volumes) +
            " series; choose one with --series UID or give its own folder:" + series_list(all),
        std::move(choice));
  }
  if (volumes == 0) {
    throw InvalidInput(folder.string() + ": holds no series of at least " +
                       std::to_string(kFewestSlices) + " slices, only" + series_list(all) +
                       "\n  give the folder of the whole scan");
  }
  if (all.size() > 1 && options.warn) {
    options.warn(folder.string() + ": reads the series \"" +
                 image_formats::printable(all.front().summary.description) +
                 "\"; passed over what is too short to be a volume");
  }
  DicomSeries chosen = std::move(all.front());  // sorted by number of slices
  for (std::size_t i = 1; i < all.size(); ++i) {
    std::move(all[i].slices.begin(), all[i].slices.end(), std::back_inserter(chosen.strays));
  }
  return chosen;
}

/// The volume file of a folder without DICOM: the only one, or the one named ct.
fs::path find_volume_file(const fs::path& folder) {
  std::vector<fs::path> found;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file() && is_volume_file(entry.path())) found.push_back(entry.path());
  }
  std::sort(found.begin(), found.end());
  if (found.empty()) {
    throw InvalidInput(folder.string() +
                       ": holds no image that this program reads; give a folder or file with " +
                       std::string(kKnownFormats));
  }
  if (found.size() == 1) return found.front();
  std::string list;
  std::vector<fs::path> named_ct;
  for (const fs::path& file : found) {
    if (file.filename().string().starts_with("ct.")) named_ct.push_back(file);
    list += "\n  " + file.string();
  }
  if (named_ct.size() == 1) return named_ct.front();
  throw InvalidInput(folder.string() + ": holds several volumes; give one of them:" + list);
}

void note_conventions(const ReadingNotes& notes, bool is_turned, const ReadOptions& options) {
  if (!options.note) return;
  for (const std::string& words : notes.conventions) options.note(words);
  if (is_turned) options.note("axes were put in the order left, posterior, superior");
  if (notes.count.rounded > 0) {
    options.note(std::to_string(notes.count.rounded) + " voxels were rounded to whole HU");
  }
  if (notes.count.clamped > 0) {
    options.note(std::to_string(notes.count.clamped) +
                 " voxels beyond -32768 to 32767 HU were clamped");
  }
}

void check_values(const ValueCount& count, const fs::path& input, const ReadOptions& options) {
  if (count.not_finite > 0) {
    throw InvalidInput(input.string() + ": " + std::to_string(count.not_finite) +
                       " voxels are not numbers (NaN or infinite); replace them, for example by "
                       "-1024 HU, and open it again");
  }
  if (!options.warn) return;
  if (count.greatest < kBoneLikelyAboveHu) {
    options.warn(input.string() +
                 ": nothing in it reaches 300 HU, so it shows no bone or is not "
                 "in Hounsfield units; check that it is the CT");
  } else if (count.least > kAirLikelyBelowHu) {
    options.warn(input.string() +
                 ": nothing in it is below -200 HU (air is -1000), so its values "
                 "may not be Hounsfield units; check its rescale intercept");
  }
  if (count.clamped > 0) {
    options.warn(input.string() + ": " + std::to_string(count.clamped) +
                 " voxels are beyond -32768 to 32767 HU and were clamped");
  }
}

void check_exists(const fs::path& input) {
  std::error_code error;
  if (!fs::exists(input, error)) {
    throw IoError(input.string() + ": does not exist; check the path");
  }
  if (fs::is_directory(input, error) && fs::is_empty(input, error)) {
    throw IoError(input.string() + ": is an empty folder; give the folder that holds the scan");
  }
}

/// The series that one DICOM file belongs to, from the files beside it.
DicomSeries series_of_file(const fs::path& file, const ReadOptions& options) {
  std::vector<DicomSeries> all = scan_dicom(file.parent_path().empty() ? "." : file.parent_path());
  for (DicomSeries& s : all) {
    const bool is_wanted = options.series_uid.empty() || s.summary.uid == options.series_uid;
    const bool holds_file = std::any_of(
        s.slices.begin(), s.slices.end(),
        [&](const DicomSlice& slice) { return slice.file.filename() == file.filename(); });
    if (is_wanted && holds_file) return std::move(s);
  }
  throw InvalidInput(file.string() + ": is a DICOM file without an image; give the scan's folder");
}

Grid<std::int16_t> read_any(const fs::path& input,
                            const ReadOptions& options,
                            ReadingNotes& notes) {
  if (fs::is_directory(input)) {
    std::vector<DicomSeries> all = scan_dicom(input);
    if (!all.empty()) {
      return read_series(choose_series(std::move(all), input, options), options.progress, notes);
    }
    return read_volume_file<std::int16_t>(find_volume_file(input), notes);
  }
  if (looks_like_dicom(input)) {
    return read_series(series_of_file(input, options), options.progress, notes);
  }
  return read_volume_file<std::int16_t>(input, notes);
}

}  // namespace

Grid<std::int16_t> read_ct(const fs::path& input, const ReadOptions& options) {
  check_exists(input);
  ReadingNotes notes;
  options.progress("reading", 0.0);
  Grid<std::int16_t> grid = read_any(input, options, notes);
  check_values(notes.count, input, options);
  note_conventions(notes, !canonical_order(grid.geometry().direction).is_identity(), options);
  grid = with_canonical_axes(std::move(grid));
  options.progress("reading", 1.0);
  return grid;
}

Grid<std::uint8_t> read_labels(const fs::path& file) {
  check_exists(file);
  ReadingNotes notes;
  Grid<std::uint8_t> grid = read_volume_file<std::uint8_t>(file, notes);
  const ValueCount& count = notes.count;
  if (count.not_finite + count.clamped + count.rounded > 0) {
    throw InvalidInput(file.string() +
                       ": is no label volume; its values must be whole numbers from 0 to 255");
  }
  return with_canonical_axes(std::move(grid));
}

std::string read_description(const fs::path& input, const std::string& series_uid) {
  check_exists(input);
  ReadOptions options;
  options.series_uid = series_uid;
  if (fs::is_directory(input)) {
    std::vector<DicomSeries> all = scan_dicom(input);
    if (all.empty()) return description_of_volume_file(find_volume_file(input));
    return choose_series(std::move(all), input, options).summary.description;
  }
  if (looks_like_dicom(input)) return series_of_file(input, options).summary.description;
  return description_of_volume_file(input);
}

}  // namespace carpus::case_io
