// interim
#pragma once
#include "geometry/vec3.hpp"
#include "simulation/input.hpp"
namespace carpus::simulation {
struct HandPlan {
  Vec3 tip;
  Vec3 shaft{0, 0, 1};
};
template <typename P, typename V>
void visit(P& plan, V&& v) noexcept
  requires requires { plan.tip; plan.shaft; }
{
  v(plan.tip);
  v(plan.shaft);
}
inline void advance(HandPlan& plan, const HandInput& wish) noexcept {
  plan.tip = wish.tip_in_patient;
  plan.shaft = wish.shaft_in_patient;
}
}  // namespace carpus::simulation
