// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "survey/ivri/ivri_cd.hpp"

namespace carpus::survey {
namespace {

class IvriQuery final : public convex::PairQuery {
 public:
  IvriQuery(const convex::ConvexBody& first, const convex::ConvexBody& second)
      : program_(first.vertices(), second.vertices()) {}

  [[nodiscard]] convex::Verdict meets(const convex::PairPose& first_from_second) noexcept override {
    switch (program_.query(first_from_second).status) {
      case IvriStatus::Meet:
        return convex::Verdict::Meet;
      case IvriStatus::Apart:
        return convex::Verdict::Apart;
      case IvriStatus::PivotLimit:
      case IvriStatus::NotFinite:
        break;
    }
    return convex::Verdict::Unknown;
  }
  void forget() noexcept override { program_.forget(); }

 private:
  IvriCd program_;
};

}  // namespace

std::unique_ptr<convex::PairQuery> make_ivri_query(const convex::ConvexBody& first,
                                                   const convex::ConvexBody& second) {
  return std::make_unique<IvriQuery>(first, second);
}

}  // namespace carpus::survey
