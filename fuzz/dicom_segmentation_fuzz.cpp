// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Any bytes for a DICOM segmentation: refused in words, or labels of segments that it names. What a
// disposable child guards in the program is run here without one, so that a library's fault shows.
#include <dcmtk/config/osconfig.h>
#include <dcmtk/oflog/oflog.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

#include "case_io/detail/segmentation_object.hpp"
#include "case_io/two_bones_test_support.hpp"
#include "refusals.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace carpus;
  static const bool is_quiet = [] {
    OFLog::configure(OFLogger::OFF_LOG_LEVEL);
    return true;
  }();
  (void)is_quiet;
  static const GridGeometry onto = case_io::test::two_bones().geometry();
  const std::string bytes(reinterpret_cast<const char*>(data), size);
  fuzz::reads_or_refuses("fuzzed: ", [&] {
    case_io::check_segmentation_structure(bytes, "fuzzed");
    Grid<std::uint8_t> labels(onto);
    const auto found = std::make_unique<case_io::SegmentationObject>();
    case_io::lay_segmentation_on(bytes, "fuzzed", onto, labels.values(), *found);
    fuzz::require(found->segments >= 1 && found->segments <= case_io::kMostSegments);
    for (const std::uint8_t label : labels.values()) fuzz::require(label <= found->segments);
    for (const auto& name : found->names) fuzz::require(name.back() == '\0');
  });
  return 0;
}
