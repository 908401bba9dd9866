// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "case_io/read_dicom_segmentation.hpp"

#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>
#include <dcmtk/oflog/oflog.h>

#include <algorithm>
#include <cstring>

#include "case_io/detail/disposable_child.hpp"
#include "case_io/detail/memory_room.hpp"
#include "case_io/detail/regular_file.hpp"
#include "case_io/detail/segmentation_object.hpp"
#include "case_io/detail/shared_array.hpp"
#include "core/error.hpp"

namespace carpus::case_io {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kLargestFile = std::uint64_t{1} << 30U;

}  // namespace

ReadSegmentation read_dicom_segmentation(const fs::path& file, const GridGeometry& onto) {
  const std::string bytes = read_whole_file(file, kLargestFile);
  check_segmentation_structure(bytes, file.string());
  OFLog::configure(OFLogger::OFF_LOG_LEVEL);  // what fails is thrown
  (void)dcmDataDict.rdlock();                 // read from its file now: the child opens none
  dcmDataDict.rdunlock();
  SharedArray<std::uint8_t> labels(onto.voxel_count());
  SharedArray<SegmentationObject> found(1);
  ChildTask task;
  task.subject = [&](std::uint64_t) { return file.string(); };
  // A data set as items and values: small values take more than their bytes.
  task.heap_bytes = (std::uint64_t{64} << 20U) + 24 * bytes.size();
  require_memory(onto.voxel_count() + task.heap_bytes, file);
  task.deadline = time_for(bytes.size() + onto.voxel_count());
  task.work = [&](std::atomic<std::uint64_t>&) {
    lay_segmentation_on(bytes, file.string(), onto, labels.values(), found.values()[0]);
  };
  run_in_child(task);
  const SegmentationObject& said = found.values()[0];
  ReadSegmentation result;
  for (std::size_t i = 0; i < std::min<std::uint64_t>(said.segments, kMostSegments); ++i) {
    const auto& name = said.names[i];
    result.names.emplace_back(name.data(), ::strnlen(name.data(), name.size()));
  }
  result.disputed = said.disputed;
  result.labels = Grid<std::uint8_t>(onto, labels.take());
  return result;
}

}  // namespace carpus::case_io
