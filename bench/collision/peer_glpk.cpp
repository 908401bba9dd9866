// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// GLPK's simplex method on the thesis's program.
#include <glpk.h>

#include "bench/collision/lp_rows.hpp"
#include "bench/collision/peers.hpp"

namespace carpus::bench {
namespace {

using convex::Verdict;

class GlpkQuery final : public convex::PairQuery {
 public:
  GlpkQuery(const convex::ConvexBody& first, const convex::ConvexBody& second)
      : rows_(first, second), problem_(glp_create_prob()) {
    glp_term_out(GLP_OFF);
    glp_init_smcp(&options_);
    options_.msg_lev = GLP_MSG_OFF;
    glp_set_obj_dir(problem_, GLP_MIN);
    glp_add_rows(problem_, 3);
    for (int i = 1; i <= 3; ++i) glp_set_row_bnds(problem_, i, GLP_FX, 1, 1);
    glp_add_cols(problem_, static_cast<int>(rows_.planes.size()));
    for (std::size_t i = 0; i < rows_.planes.size(); ++i) {
      glp_set_col_bnds(problem_, static_cast<int>(i) + 1, GLP_LO, 0, 0);
      if (i < rows_.second_start) load(i);
    }
  }
  ~GlpkQuery() override { glp_delete_prob(problem_); }
  GlpkQuery(const GlpkQuery&) = delete;
  GlpkQuery& operator=(const GlpkQuery&) = delete;

  Verdict meets(const convex::PairPose& pose) noexcept override {
    rows_.place(pose);
    for (std::size_t i = rows_.second_start; i < rows_.planes.size(); ++i) load(i);
    if (is_cold_) glp_std_basis(problem_);
    is_cold_ = false;
    int failed = glp_simplex(problem_, &options_);
    if (failed == GLP_EBADB || failed == GLP_ESING || failed == GLP_ECOND) {
      glp_std_basis(problem_);
      failed = glp_simplex(problem_, &options_);
    }
    if (failed != 0) return Verdict::Unknown;
    const int status = glp_get_status(problem_);
    if (status == GLP_OPT) return Verdict::Meet;
    return status == GLP_UNBND ? Verdict::Apart : Verdict::Unknown;
  }
  void forget() noexcept override { is_cold_ = true; }

 private:
  void load(std::size_t i) noexcept {
    constexpr int kIndices[] = {0, 1, 2, 3};
    const Plane& p = rows_.planes[i];
    const double values[] = {0, p.normal.x, p.normal.y, p.normal.z};
    const int column = static_cast<int>(i) + 1;
    glp_set_mat_col(problem_, column, 3, kIndices, values);
    glp_set_obj_coef(problem_, column, p.offset);
  }
  LpRows rows_;
  glp_prob* problem_;
  glp_smcp options_{};
  bool is_cold_ = true;
};

}  // namespace

PairEngine glpk_engine() {
  return {"glpk", true, false, false, [](const convex::ConvexBody& a, const convex::ConvexBody& b) {
            return std::make_unique<GlpkQuery>(a, b);
          }};
}

}  // namespace carpus::bench
