// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Bodies by the names of their meshes and in words, structures in words. A body is named by its
// place in CaseData::bones, a structure by its place in CaseData::structures.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "cases/case_data.hpp"

namespace carpus::session {

class BodyNames {
 public:
  explicit BodyNames(const cases::CaseData& data);

  [[nodiscard]] std::size_t size() const noexcept { return bodies_.size(); }
  /// "scaphoid_proximal"; empty where there is no such body.
  [[nodiscard]] const std::string& name(std::size_t body) const noexcept;
  /// "proximal part of the scaphoid"; "bone" where there is no such body.
  [[nodiscard]] const std::string& words(std::size_t body) const noexcept;
  /// "extensor pollicis longus"; "structure" where there is no such one.
  [[nodiscard]] const std::string& structure(std::size_t index) const noexcept;
  /// "3-4 portal"; "a portal" where there is no such one.
  [[nodiscard]] const std::string& portal(std::size_t index) const noexcept;
  /// "radial styloid", by its number in the tour; "a point" where there is no such one.
  [[nodiscard]] const std::string& tour_point(std::int32_t number) const noexcept;

 private:
  struct Body {
    std::string name;
    std::string words;
  };
  std::vector<Body> bodies_;
  std::vector<std::string> structures_;
  std::vector<std::string> portals_;
  std::map<std::int32_t, std::string> tour_;
};

}  // namespace carpus::session
