// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Reads soft_tissue.json of a case folder (docs/case_format.md).
#pragma once

#include <functional>
#include <string>

#include "geometry/triangle_mesh.hpp"
#include "soft_tissue/soft_tissue.hpp"

namespace carpus::case_io {

inline constexpr int kSoftTissueSchemaVersion = 1;

/// A surface that the text names: a plain name of a file beside it. May throw IoError.
using ReadMesh = std::function<TriangleMesh(const std::string& name)>;

/// @throws SchemaError where a newer program wrote it, IoError where it is damaged or a surface
///     cannot be read, all naming `file` and what to do.
[[nodiscard]] soft_tissue::SoftTissue parse_soft_tissue(const std::string& text,
                                                        const std::string& file,
                                                        const ReadMesh& read);

}  // namespace carpus::case_io
