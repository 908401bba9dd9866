// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "collision/ivri/ivri_cd.hpp"

namespace carpus::collision {
namespace {

class IvriQuery final : public PairQuery {
 public:
  IvriQuery(const ConvexBody& first, const ConvexBody& second)
      : program_(first.vertices(), second.vertices()) {}

  [[nodiscard]] Verdict meets(const PairPose& first_from_second) noexcept override {
    switch (program_.query(first_from_second).status) {
      case IvriStatus::Meet:
        return Verdict::Meet;
      case IvriStatus::Apart:
        return Verdict::Apart;
      case IvriStatus::PivotLimit:
      case IvriStatus::NotFinite:
        break;
    }
    return Verdict::Unknown;
  }
  void forget() noexcept override { program_.forget(); }

 private:
  IvriCd program_;
};

}  // namespace

std::unique_ptr<PairQuery> make_ivri_query(const ConvexBody& first, const ConvexBody& second) {
  return std::make_unique<IvriQuery>(first, second);
}

}  // namespace carpus::collision
