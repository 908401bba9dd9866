// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Surfaces as STL: triangles without shared vertices, in single precision.
#pragma once

#include <filesystem>
#include <string_view>

#include "geometry/triangle_mesh.hpp"

namespace carpus::case_io {

/// Binary or text, told apart by the length that a binary header promises. Corners with the same
/// coordinates become one vertex, in order of appearance; normals are not read.
/// @param file  what errors name.
/// @throws IoError naming the file and what is wrong.
[[nodiscard]] TriangleMesh parse_stl(std::string_view content, const std::filesystem::path& file);

/// Binary, coordinates rounded to single precision.
/// @throws IoError where the file cannot be written whole.
void write_stl(const std::filesystem::path& file, const TriangleMesh& mesh);

}  // namespace carpus::case_io
