// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Reading a CT and label volumes: DICOM series, NIfTI, NRRD and MetaImage give the same grid, in
// LPS, whichever format the volume came from. Nothing in a file is believed: headers are parsed by
// image_formats, pixels are decoded in a child process, and what contradicts itself is refused.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "core/progress.hpp"
#include "geometry/grid.hpp"

namespace carpus::case_io {

/// One DICOM series of a folder.
struct SeriesSummary {
  std::string uid;          ///< SeriesInstanceUID; what `--series` takes
  std::string description;  ///< SeriesDescription, may be empty
  std::string modality;     ///< "CT", ...
  int slices = 0;
  std::filesystem::path folder;  ///< of its first file
  Vec3 spacing_mm{};  ///< of voxels: along a row, along a column, of slices; 0 where not known
};

/// A folder holds several volumes of which one must be chosen, ReadOptions::series_uid.
class SeveralSeries : public InvalidInput {
 public:
  SeveralSeries(const std::string& message, std::vector<SeriesSummary> volumes)
      : InvalidInput(message), volumes_(std::move(volumes)) {}
  /// Those that are long enough for a volume, most slices first; scouts are not among them.
  [[nodiscard]] const std::vector<SeriesSummary>& volumes() const noexcept { return volumes_; }

 private:
  std::vector<SeriesSummary> volumes_;
};

struct ReadOptions {
  std::string series_uid;  ///< which DICOM series of the folder; empty: the only one
  std::function<void(const std::string&)> warn;  ///< receives doubts, in words for the user
  /// Receives what was taken by convention (scaling, order of slices and axes, rounding), for the
  /// report and the case's provenance.
  std::function<void(const std::string&)> note;
  Progress progress = no_progress;  ///< called from this thread only, never more often than a slice
};

/// Reads a CT in HU. `input` is a file (.nii, .nii.gz, .nrrd, .nhdr, .mha, .mhd, or one DICOM file,
/// which stands for its series in that folder) or a folder, which is searched recursively for a
/// DICOM series, else for one volume file.
///
/// The grid's axes are those nearest to +x, +y, +z of LPS, so that the same voxels give the same
/// grid whichever way round a file stored them. Rescale slope and intercept are applied; values are
/// rounded to whole HU and clamped to int16. Patient names are never read.
/// @throws IoError missing, empty, unreadable, damaged or truncated files, files that need more
/// memory than there is, and what is no regular file.
/// @throws SeveralSeries a choice is needed.
/// @throws InvalidInput missing slices, uneven or impossible geometry, not finite
/// values. Messages name the file and say what to do.
[[nodiscard]] Grid<std::int16_t> read_ct(const std::filesystem::path& input,
                                         const ReadOptions& options = {});

/// Reads a label volume (numbers in anatomy/bone_id.hpp) from a volume file; axes as read_ct.
/// @throws as read_ct; InvalidInput too where a value is not a whole number from 0 to 255.
[[nodiscard]] Grid<std::uint8_t> read_labels(const std::filesystem::path& file);

/// What the scan that read_ct would read says about itself: the SeriesDescription of DICOM, NIfTI's
/// `descrip`, the field ITK_FileNotes of NRRD and MetaImage. May be empty.
/// @throws as read_ct where there is nothing to choose from.
[[nodiscard]] std::string read_description(const std::filesystem::path& input,
                                           const std::string& series_uid = {});

}  // namespace carpus::case_io
