// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A folder that is whole or not there: its files are written into a hidden sibling, which takes the
// place of the target in one step when all are safely on the disk.
#pragma once

#include <filesystem>

namespace carpus::case_io {

enum class Overwrite { Refuse, Replace };

/// Usage: write into `staging()`, then `commit()`. Without commit (an exception, a full disk) the
/// staging folder is removed and the target stays as it was.
class AtomicFolder {
 public:
  /// Clears what killed programs left beside the target first.
  /// @throws IoError where the target exists and is not empty (with Overwrite::Refuse), is a file,
  /// or its parent cannot be written to.
  explicit AtomicFolder(std::filesystem::path target, Overwrite overwrite = Overwrite::Refuse);
  ~AtomicFolder();
  AtomicFolder(const AtomicFolder&) = delete;
  AtomicFolder& operator=(const AtomicFolder&) = delete;

  [[nodiscard]] const std::filesystem::path& staging() const noexcept { return staging_; }

  /// Forces every file to the disk and puts the folder in place. An existing target is exchanged in
  /// one step and removed afterwards, so that at every moment one of the two is there, whole.
  /// @throws IoError where the disk refuses; the target is then as it was.
  void commit();

 private:
  std::filesystem::path target_;
  std::filesystem::path staging_;
  int lock_ = -1;  ///< of the staging folder: somebody writes there
  bool is_committed_ = false;
};

}  // namespace carpus::case_io
