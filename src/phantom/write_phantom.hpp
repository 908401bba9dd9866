// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The folder that `carpus phantom` makes: the simulated CT and its truth.
#pragma once

#include <filesystem>

#include "case_io/atomic_folder.hpp"
#include "core/progress.hpp"
#include "phantom/phantom.hpp"

namespace carpus::phantom {

enum class CtFormat { Dicom, Nifti };

/// Writes DIR/dicom/IM_0001.dcm ... or DIR/ct.nii.gz, DIR/labels.nii.gz, DIR/labels.json (the
/// number of each label) and DIR/truth.json (options, poses, fracture; docs/case_format.md). All or
/// nothing: DIR appears when everything is written.
/// @throws IoError where the folder is in the way or the disk is full.
void write_phantom(const Phantom& phantom,
                   const std::filesystem::path& folder,
                   CtFormat format,
                   case_io::Overwrite overwrite = case_io::Overwrite::Refuse,
                   const Progress& progress = no_progress);

}  // namespace carpus::phantom
