// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// lesson.json, what a case is for (cases/lesson.hpp), and preview.png, how it looks. Both are
// beside what `carpus reconstruct` writes, and a case need not have them (docs/case_format.md).
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "cases/lesson.hpp"

namespace carpus::case_io {

inline constexpr const char* kLessonFile = "lesson.json";
inline constexpr const char* kPreviewFile = "preview.png";

[[nodiscard]] std::string lesson_text(const cases::Lesson& lesson);

/// @throws InvalidInput naming `file` and field: missing, of another kind, out of its range, too
/// long, or not known.
/// @throws SchemaError where a newer program wrote it.
[[nodiscard]] cases::Lesson parse_lesson(const std::string& text, const std::string& file);

/// Of a case folder; nothing where it has none.
/// @throws as parse_lesson; IoError where it cannot be read.
[[nodiscard]] std::optional<cases::Lesson> read_lesson(const std::filesystem::path& folder);

}  // namespace carpus::case_io
