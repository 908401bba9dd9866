// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// CLP's primal simplex method on the thesis's program.
#include <ClpSimplex.hpp>

#include "bench/collision/lp_rows.hpp"
#include "bench/collision/peers.hpp"

namespace carpus::bench {
namespace {

using convex::Verdict;

class ClpQuery final : public convex::PairQuery {
 public:
  ClpQuery(const convex::ConvexBody& first, const convex::ConvexBody& second)
      : rows_(first, second) {
    const std::size_t n = rows_.planes.size();
    values_.resize(3 * n);
    costs_.resize(n);
    lower_.assign(n, 0);
    upper_.assign(n, COIN_DBL_MAX);
    for (std::size_t i = 0; i < n; ++i) {
      starts_.push_back(static_cast<CoinBigIndex>(3 * i));
      for (int k = 0; k < 3; ++k) indices_.push_back(k);
    }
    starts_.push_back(static_cast<CoinBigIndex>(3 * n));
    for (std::size_t i = 0; i < rows_.second_start; ++i) load(i);
    model_.setLogLevel(0);
  }
  Verdict meets(const convex::PairPose& pose) noexcept override {
    rows_.place(pose);
    for (std::size_t i = rows_.second_start; i < rows_.planes.size(); ++i) load(i);
    constexpr double kOnes[] = {1, 1, 1};
    const std::size_t statuses = rows_.planes.size() + 3;
    model_.loadProblem(static_cast<int>(rows_.planes.size()), 3, starts_.data(), indices_.data(),
                       values_.data(), lower_.data(), upper_.data(), costs_.data(), kOnes, kOnes);
    if (!status_.empty()) model_.copyinStatus(status_.data());
    model_.primal();
    status_.assign(model_.statusArray(), model_.statusArray() + statuses);
    if (model_.status() == 0) return Verdict::Meet;
    return model_.status() == 2 ? Verdict::Apart : Verdict::Unknown;
  }
  void forget() noexcept override { status_.clear(); }

 private:
  void load(std::size_t i) noexcept {
    const Plane& p = rows_.planes[i];
    values_[3 * i] = p.normal.x;
    values_[3 * i + 1] = p.normal.y;
    values_[3 * i + 2] = p.normal.z;
    costs_[i] = p.offset;
  }
  LpRows rows_;
  ClpSimplex model_;
  std::vector<CoinBigIndex> starts_;
  std::vector<int> indices_;
  std::vector<double> values_;
  std::vector<double> costs_;
  std::vector<double> lower_;
  std::vector<double> upper_;
  std::vector<unsigned char> status_;
};

}  // namespace

PairEngine clp_engine() {
  return {"clp", true, false, false, [](const convex::ConvexBody& a, const convex::ConvexBody& b) {
            return std::make_unique<ClpQuery>(a, b);
          }};
}

}  // namespace carpus::bench
