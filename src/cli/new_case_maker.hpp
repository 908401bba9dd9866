// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What a page brought becomes a case: by this program's own commands, in a process of its own, in a
// folder beside, which takes its place among the cases when it is whole.
#pragma once

#include <filesystem>
#include <memory>

#include "server/case_shelf.hpp"
#include "server/new_case_desk.hpp"

namespace carpus::cli {

/// "demo-2", "demo-3": what no case on the shelf and no file in the folder is called yet; letters,
/// digits and hyphens of what it is made from.
[[nodiscard]] std::string free_id(const std::string& from,
                                  const server::CaseShelf& shelf,
                                  const std::filesystem::path& folder);

class NewCaseMaker {
 public:
  /// @param program  carpus
  /// @param cases  the folder for new ones, on one file system with what is brought
  NewCaseMaker(std::filesystem::path program,
               std::filesystem::path cases,
               std::shared_ptr<server::SharedShelf> shelf);

  /// NewCaseOptions::make
  [[nodiscard]] server::NewCaseOutcome make(const server::NewCaseTask& task,
                                            const Progress& progress,
                                            const std::atomic<bool>& stop) const;

 private:
  [[nodiscard]] server::NewCaseOutcome look(const server::NewCaseTask& task,
                                            const server::ShelvedCase& of,
                                            const Progress& progress,
                                            const std::atomic<bool>& stop) const;
  [[nodiscard]] server::NewCaseOutcome put_on_shelf(const server::NewCaseTask& task,
                                                    const std::filesystem::path& made) const;

  std::filesystem::path program_;
  std::filesystem::path cases_;
  std::shared_ptr<server::SharedShelf> shelf_;
};

}  // namespace carpus::cli
