// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "arthroscopy/fluid_table.hpp"

#include <nlohmann/json.hpp>
#include <string>

#include "core/error.hpp"

namespace carpus::data {
std::string_view joint_fluid();
}

namespace carpus::arthroscopy {
namespace {

using Json = nlohmann::json;

constexpr double kGreatest = 1e4;  // of any figure, in its unit

[[noreturn]] void refuse(const std::string& what) {
  throw InvalidInput("joint_fluid.json: " + what);
}

/// The figures of one part, each above zero and with its mark.
class Part {
 public:
  Part(const Json& root, const std::string& name) : name_(name), json_(root.at(name)) {}
  [[nodiscard]] double operator()(const std::string& figure) {
    const std::string where = name_ + "." + figure;
    ++read_;
    if (!json_.contains(figure)) refuse(where + " is missing");
    const Json& entry = json_.at(figure);
    const double value = entry.at("value");
    if (!(value > 0 && value <= kGreatest)) refuse(where + ": must be above 0");
    if (entry.at("mark").get<std::string>().empty()) refuse(where + ": says where it is from");
    return value;
  }
  void refuse_others() const {
    if (json_.size() != read_) refuse(name_ + " has a figure that nothing reads");
  }

 private:
  std::string name_;
  const Json& json_;
  std::size_t read_ = 0;
};

FluidSource source_from(Part part) {
  const FluidSource source{part("inflow_mmhg"), part("most_inflow_mmhg"),
                           part("step_mmhg"),   part("sheath_mmhg_s_per_ml"),
                           part("sheath_mm"),   part("flush_mmhg"),
                           part("flush_s")};
  part.refuse_others();
  if (source.inflow_mmhg > source.most_inflow_mmhg) refuse("source: begins beyond its most");
  constexpr double kMostSteps = 63;  // a command has room for as many
  if (source.most_inflow_mmhg > kMostSteps * source.step_mmhg) refuse("source: over 63 steps");
  return source;
}

FluidJoint joint_from(Part part) {
  const FluidJoint joint{part("rest_ml"),
                         part("ml_per_mmhg"),
                         part("outflow_mmhg_s_per_ml"),
                         part("portal_mmhg_s_per_ml"),
                         part("tissue_from_mmhg"),
                         part("tissue_mmhg_s_per_ml"),
                         part("most_mmhg"),
                         part("shaver_ml_per_s"),
                         part("swells_ml")};
  part.refuse_others();
  return joint;
}

FluidBleeding bleeding_from(Part part) {
  const FluidBleeding bleeding{part("pressure_mmhg"),   part("tourniquet_mmhg"),
                               part("portal_ml_per_s"), part("injury_ml_per_s2"),
                               part("tuft_ml_per_s"),   part("most_ml_per_s"),
                               part("stops_s")};
  part.refuse_others();
  return bleeding;
}

FluidAir air_from(Part part) {
  const FluidAir air{part("exchange_ml"), part("shown_ml"), part("washed_ml")};
  part.refuse_others();
  return air;
}

FluidLens lens_from(Part part) {
  const FluidLens lens{part("cools_s"), part("warms_s"), part("smear_per_s"),
                       part("smear_by_blood"), part("rinsed_s")};
  part.refuse_others();
  return lens;
}

FluidView view_from(Part part) {
  const FluidView view{part("haze_per_mm"), part("fog_depth"), part("smear_depth"),
                       part("hidden_depth"), part("clouded_at_mm")};
  part.refuse_others();
  return view;
}

}  // namespace

FluidTable FluidTable::parse(std::string_view json_text) {
  try {
    const Json json = Json::parse(json_text);
    return {source_from({json, "source"}),     joint_from({json, "joint"}),
            bleeding_from({json, "bleeding"}), air_from({json, "air"}),
            lens_from({json, "lens"}),         view_from({json, "view"})};
  } catch (const Json::exception& error) {
    refuse(error.what());
  }
}

const FluidTable& FluidTable::generic() {
  static const FluidTable kTable = parse(data::joint_fluid());
  return kTable;
}

}  // namespace carpus::arthroscopy
