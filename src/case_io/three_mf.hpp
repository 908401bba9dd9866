// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Surfaces as 3MF, which printers' programs open: one object each, with its name, in mm.
#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "case_io/glb.hpp"

namespace carpus::case_io {

/// Writes the surfaces where they are now [Patient, mm; single precision, as the format holds].
/// @param title  said in the file, with whether what it holds is simulated.
/// @throws InvalidInput where a surface is empty or too large; IoError where the file cannot be
/// written.
void write_3mf(const std::filesystem::path& file,
               std::span<const NamedMesh> meshes,
               const std::string& title);

}  // namespace carpus::case_io
