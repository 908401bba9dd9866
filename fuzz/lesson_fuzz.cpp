// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Any bytes for a case's lesson.json: refused in words that name the file, or a lesson that comes
// back from its text.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>

#include "case_io/lesson_file.hpp"
#include "refusals.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace carpus;
  fuzz::reads_or_refuses("lesson.json", [&] {
    const cases::Lesson lesson =
        case_io::parse_lesson({reinterpret_cast<const char*>(data), size}, "lesson.json");
    fuzz::require(std::isfinite(lesson.difficulty.overall));
    const std::string text = case_io::lesson_text(lesson);
    fuzz::require(case_io::parse_lesson(text, "lesson.json") == lesson);
  });
  return 0;
}
