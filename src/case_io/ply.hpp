// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Surfaces as binary PLY, which 3D Slicer, Blender and MeshLab open.
#pragma once

#include <filesystem>
#include <span>
#include <string_view>

#include "geometry/triangle_mesh.hpp"

namespace carpus::case_io {

/// Writes binary little-endian PLY with double vertices, so that reading gives the same bits back.
/// @param normals  of the vertices, as nx, ny, nz; may be empty
/// @param remark  a comment in the file's header, of one line; may be empty
/// @throws IoError where the file cannot be written whole.
void write_ply(const std::filesystem::path& file,
               const TriangleMesh& mesh,
               std::span<const Vec3> normals = {},
               std::string_view remark = {});

/// Reads binary little-endian PLY with scalar vertex properties x, y, z (others are skipped) and
/// triangles. Nothing in the file is believed before it is checked: counts against the file's
/// length, indices against the vertices, coordinates for being finite.
/// @throws IoError naming the file and what is wrong.
[[nodiscard]] TriangleMesh read_ply(const std::filesystem::path& file);

/// The same of bytes at hand. @param file  what errors name.
[[nodiscard]] TriangleMesh parse_ply(std::string_view content, const std::filesystem::path& file);

/// The same, and text PLY (polygons become fans), and points without facets.
[[nodiscard]] TriangleMesh parse_ply_or_points(std::string_view content,
                                               const std::filesystem::path& file);

}  // namespace carpus::case_io
