// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Instruments from JSON (format: data/README.md). What holds an instrument is written once, as a
// holder, and added to the parts and rods of whatever it holds.
#include <array>
#include <cstdio>
#include <map>
#include <utility>

#include "core/error.hpp"
#include "core/json_fields.hpp"
#include "instruments/instrument.hpp"

namespace carpus::instruments {
namespace {

constexpr double kLongestMm = 400.0;
constexpr double kWidestMm = 40.0;
constexpr double kLeastMm = 0.05;  // of what has a width at all
constexpr double kGreatestN = 100.0;
constexpr double kFastestMmPerS = 50.0;

constexpr std::array<std::string_view, 4> kShapes{"sphere", "capsule", "cone_tip",
                                                  "threaded_cylinder"};
constexpr std::array<std::string_view, 4> kWorks{"none", "drill", "ream", "thread"};
constexpr std::array<std::string_view, kSkinWorks> kSkinWorkNames{"palpate", "mark",   "needle",
                                                                  "incise",  "spread", "sheath"};
constexpr std::array<std::string_view, 3> kDrives{"none", "powered", "by_hand"};
constexpr std::array<std::string_view, 5> kMaterials{"steel", "titanium", "handle", "black",
                                                     "glove"};

struct Held {
  std::vector<DrawnPart> parts;
  std::vector<BeamRod> rods;
};
using Holders = std::map<std::string, Held>;

/// "24" or "22.5".
std::string short_number(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%g", value);
  return text.data();
}

Vec3 read_vector(JsonFields& fields, const std::string& field, double greatest) {
  const std::vector<double> v = fields.numbers(field, 3, -greatest, greatest);
  return {v[0], v[1], v[2]};
}

Material read_material(JsonFields& fields) {
  return static_cast<Material>(fields.choice("material", kMaterials));
}

double read_radius(JsonFields& fields, const std::string& field) {
  return fields.number(field, kLeastMm, kWidestMm);
}

InstrumentShape read_shape(JsonFields fields) {
  const std::size_t kind = fields.choice("kind", kShapes);
  const auto length = [&] { return fields.number("length_mm", 1.0, kLongestMm); };
  const auto shape = [&]() -> InstrumentShape {
    switch (kind) {
      case 0:
        return InstrumentShape(SphereShape{read_radius(fields, "radius_mm")});
      case 1:
        return InstrumentShape(CapsuleShape{read_radius(fields, "radius_mm"), length()});
      case 2:
        return InstrumentShape(ConeTipShape{read_radius(fields, "radius_mm"),
                                            fields.number("cone_mm", kLeastMm, kWidestMm),
                                            length()});
      default:
        return InstrumentShape(ThreadedCylinderShape{
            read_radius(fields, "core_radius_mm"), read_radius(fields, "crest_radius_mm"),
            fields.number("pitch_mm", kLeastMm, 20.0), length()});
    }
  };
  try {
    InstrumentShape result = shape();
    fields.refuse_unknown_fields();
    return result;
  } catch (const InvalidInput& problem) {
    // What the shape itself refuses does not know file and place.
    if (std::string(problem.what()).find(fields.place()) != std::string::npos) throw;
    fields.refuse(problem.what());
  }
}

Feed read_feed(JsonFields fields) {
  Feed feed;
  feed.bite_n = fields.number("bite_n", 0.0, kGreatestN);
  feed.resistance_share = fields.number("resistance_share", 0.0, 10.0);
  feed.mm_per_s_per_n = fields.number("mm_per_s_per_n", 0.0, kFastestMmPerS);
  feed.fastest_mm_per_s = fields.number("fastest_mm_per_s", 0.0, kFastestMmPerS);
  feed.back_mm_per_s = fields.number("back_mm_per_s", 0.0, kFastestMmPerS);
  fields.refuse_unknown_fields();
  return feed;
}

DrawnPart read_thread_part(JsonFields thread) {
  DrawnPart part;
  part.is_threaded = true;
  part.from_mm = thread.number("from_mm", -kLongestMm, kLongestMm);
  part.to_mm = thread.number("to_mm", part.from_mm + kLeastMm, kLongestMm);
  part.radius_mm = read_radius(thread, "radius_mm");
  part.end_radius_mm = read_radius(thread, "end_radius_mm");
  part.pitch_mm = thread.number("pitch_mm", kLeastMm, 20.0);
  part.end_pitch_mm = thread.number("end_pitch_mm", kLeastMm, 20.0);
  thread.refuse_unknown_fields();
  return part;
}

/// Cones and cylinders end to end through points [radius, z].
std::vector<DrawnPart> read_profile(JsonFields& fields) {
  const nlohmann::json& points = fields.value("profile");
  if (!points.is_array() || points.size() < 2)
    fields.refuse("profile is no list of two points or more");
  std::vector<DrawnPart> parts;
  std::array<double, 2> last{};
  for (std::size_t i = 0; i < points.size(); ++i) {
    const nlohmann::json point_as_field{{"point", points[i]}};
    JsonFields point(point_as_field, "", "");
    std::vector<double> now;
    try {
      now = point.numbers("point", 2, -kLongestMm, kLongestMm);
    } catch (const InvalidInput&) {
      now = {-1, 0};
    }
    if (!(now[0] >= 0 && now[0] <= kWidestMm)) {
      fields.refuse("profile[" + std::to_string(i) + "] is no [radius, z] in mm");
    }
    if (i > 0) {
      DrawnPart part;
      part.from_mm = last[1];
      part.to_mm = now[1];
      part.radius_mm = last[0];
      part.end_radius_mm = now[0];
      parts.push_back(part);
    }
    last = {now[0], now[1]};
  }
  return parts;
}

std::vector<DrawnPart> read_parts(JsonFields& fields) {
  std::vector<DrawnPart> parts;
  for (JsonFields& entry : fields.objects("parts")) {
    std::vector<DrawnPart> read = entry.has("thread")
                                      ? std::vector{read_thread_part(entry.object("thread"))}
                                      : read_profile(entry);
    const Material material = read_material(entry);
    const Vec3 origin =
        entry.has("origin_mm") ? read_vector(entry, "origin_mm", kLongestMm) : Vec3{};
    Vec3 axis{0, 0, 1};
    if (entry.has("axis")) {
      axis = normalized_or(read_vector(entry, "axis", 1.0), {});
      if (!(squared_length(axis) > 0)) entry.refuse("axis has no direction");
    }
    std::array<double, 2> squash{1, 1};
    if (entry.has("squash")) {
      const std::vector<double> both = entry.numbers("squash", 2, 0.1, 10.0);
      squash = {both[0], both[1]};
    }
    entry.refuse_unknown_fields();
    for (DrawnPart& part : read) {
      part.material = material;
      part.origin_mm = origin;
      part.axis = axis;
      part.squash = squash;
      parts.push_back(part);
    }
  }
  return parts;
}

std::vector<BeamRod> read_rods(JsonFields& fields) {
  std::vector<BeamRod> rods;
  for (JsonFields& entry : fields.objects("rods")) {
    BeamRod rod;
    rod.from_mm = entry.number("from_mm", -kLongestMm, kLongestMm);
    rod.to_mm = entry.number("to_mm", rod.from_mm + kLeastMm, kLongestMm);
    rod.radius_mm = read_radius(entry, "radius_mm");
    rod.end_radius_mm = read_radius(entry, "end_radius_mm");
    rod.bore_radius_mm = entry.number_or("bore_radius_mm", 0.0, kWidestMm, 0.0);
    rod.thread_depth_mm = entry.number_or("thread_depth_mm", 0.0, 5.0, 0.0);
    rod.thread_pitch_mm = entry.number_or("thread_pitch_mm", kLeastMm, 20.0, 1.0);
    rod.material = read_material(entry);
    entry.refuse_unknown_fields();
    rods.push_back(rod);
  }
  return rods;
}

Holders read_holders(JsonFields& file) {
  Holders holders;
  if (!file.has("holders")) return holders;
  for (JsonFields& entry : file.objects("holders")) {
    const std::string id = entry.text("id");
    entry.set_place(id);
    if (!holders.emplace(id, Held{read_parts(entry), read_rods(entry)}).second) {
      entry.refuse("there are two holders of this id");
    }
    entry.refuse_unknown_fields();
  }
  return holders;
}

/// Adds what holds it, `at_mm` behind its tip.
void hold(Instrument& instrument, const Held& held, double at_mm) {
  for (DrawnPart part : held.parts) {
    part.only_in_hand = true;
    part.origin_mm.z += at_mm;
    // Along z the place says more than an origin.
    if (part.axis == Vec3{0, 0, 1}) {
      part.from_mm += part.origin_mm.z;
      part.to_mm += part.origin_mm.z;
      part.origin_mm.z = 0;
    }
    instrument.parts.push_back(part);
  }
  for (BeamRod rod : held.rods) {
    rod.only_in_hand = true;
    rod.from_mm += at_mm;
    rod.to_mm += at_mm;
    instrument.rods.push_back(rod);
  }
}

const Held& find_holder(const Holders& holders, const JsonFields& fields, const std::string& id) {
  const auto found = holders.find(id);
  if (found == holders.end()) fields.refuse("there is no holder '" + id + "'");
  return found->second;
}

void read_work(JsonFields& fields, Instrument& instrument) {
  instrument.work = static_cast<Work>(fields.choice("work", kWorks));
  instrument.drive = static_cast<Drive>(fields.choice("drive", kDrives));
  const bool works = instrument.work != Work::None;
  if (works != (instrument.drive != Drive::None)) {
    fields.refuse("work and drive must both be none, or neither");
  }
  instrument.bore_radius_mm = fields.number_or("bore_radius_mm", kLeastMm, kWidestMm, 0.0);
  if (instrument.work == Work::Ream || instrument.work == Work::Thread) {
    if (!fields.has("bore_radius_mm"))
      fields.refuse("bore_radius_mm is missing: it runs on a wire");
  }
  if (!works) return;
  instrument.feed = read_feed(fields.object("feed"));
  JsonFields cut = fields.object("cut");
  instrument.cut_tip_radius_mm = read_radius(cut, "tip_radius_mm");
  instrument.cut_tail_radius_mm = read_radius(cut, "tail_radius_mm");
  instrument.cut_length_mm = cut.number("length_mm", 1.0, kLongestMm);
  cut.refuse_unknown_fields();
}

SkinTool read_skin_tool(JsonFields fields) {
  SkinTool tool;
  tool.work = static_cast<SkinWork>(fields.choice("work", kSkinWorkNames));
  tool.gives_share = fields.number("gives_share", 0.0, 0.95);
  tool.skin_n = fields.number_or("skin_n", 0.0, kGreatestN, 0.0);
  tool.way_n = fields.number_or("way_n", 0.0, kGreatestN, 0.0);
  tool.unspread_n = fields.number_or("unspread_n", 0.0, kGreatestN, 0.0);
  tool.capsule_n = fields.number_or("capsule_n", 0.0, kGreatestN, 0.0);
  tool.reaim_mm = fields.number_or("reaim_mm", 0.0, 20.0, 0.0);
  fields.refuse_unknown_fields();
  return tool;
}

Instrument read_instrument(JsonFields& fields, const Holders& holders) {
  Instrument instrument;
  instrument.id = fields.text("id");
  fields.set_place(instrument.id);
  instrument.name = fields.text("name");
  instrument.use = fields.text("use");
  instrument.mark = fields.text("mark");
  instrument.shape = read_shape(fields.object("shape"));
  instrument.length_mm = fields.number("length_mm", 1.0, kLongestMm);
  read_work(fields, instrument);
  instrument.is_sleeve = fields.boolean_or("is_sleeve", false);
  instrument.gauge_step_mm = fields.number_or("gauge_step_mm", 0.01, 5.0, 0.0);
  instrument.is_gauge = fields.has("gauge_step_mm");
  if ((instrument.is_sleeve || instrument.is_gauge) && !(instrument.bore_radius_mm > 0)) {
    fields.refuse("bore_radius_mm is missing: a wire runs in it");
  }
  instrument.stays = fields.boolean_or("stays", false);
  instrument.is_joystick = fields.boolean_or("joystick", false);
  instrument.enters_joints = fields.boolean_or("enters_joints", false);
  instrument.has_jaws = fields.boolean_or("jaws", false);
  if (fields.has("mouth")) {
    JsonFields mouth = fields.object("mouth");
    instrument.mouth = Mouth{mouth.number("behind_mm", 0, 10), mouth.number("reach_mm", 0.1, 5)};
    mouth.refuse_unknown_fields();
  }
  if (fields.has("bite")) {
    if (!instrument.has_jaws) fields.refuse("bite: nothing without jaws bites");
    JsonFields bite = fields.object("bite");
    instrument.bite = Bite{bite.number("behind_mm", 0, 10), bite.number("reach_mm", 0.1, 5),
                           bite.number("width_mm", 0.1, 10)};
    bite.refuse_unknown_fields();
  }
  if (fields.has("skin")) instrument.skin = read_skin_tool(fields.object("skin"));
  if (fields.has("optic")) {
    JsonFields optic = fields.object("optic");
    instrument.optic =
        Optic{optic.number("view_angle_deg", 0, 90), optic.number("field_deg", 10, 150)};
    optic.refuse_unknown_fields();
  }
  instrument.is_double_pointed = fields.boolean_or("double_pointed", false);
  instrument.parts = read_parts(fields);
  instrument.rods = read_rods(fields);
  if (fields.has("holder")) {
    JsonFields holder = fields.object("holder");
    const Held& held = find_holder(holders, holder, holder.text("id"));
    hold(instrument, held, holder.number("at_mm", 0.0, kLongestMm));
    holder.refuse_unknown_fields();
  }
  instrument.is_confirmed = fields.boolean_or("confirmed", false);
  fields.refuse_unknown_fields();
  return instrument;
}

/// What all lengths of a family share.
struct ScrewFamily {
  Instrument screw;
  double depth_mm = 0.0;
  double pitch_mm = 0.0;
  double tip_pitch_mm = 0.0;
  double tail_pitch_mm = 0.0;
  Material material = Material::Titanium;
  const Held* holder = nullptr;
};

ScrewFamily read_family(JsonFields& fields, const Holders& holders) {
  ScrewFamily family;
  Instrument& screw = family.screw;
  screw.family = fields.text("id");
  fields.set_place(screw.family);
  screw.name = fields.text("name");
  screw.use = fields.text("use");
  screw.mark = fields.text("mark");
  screw.work = Work::Thread;
  screw.drive = Drive::ByHand;
  screw.stays = true;
  screw.tip_diameter_mm = fields.number("tip_diameter_mm", 0.5, 15.0);
  screw.tail_diameter_mm = fields.number("tail_diameter_mm", 0.5, 15.0);
  screw.bore_radius_mm = fields.number("wire_diameter_mm", 0.2, 10.0) / 2 +
                         fields.number("bore_clearance_mm", 0.0, 1.0);
  JsonFields thread = fields.object("thread");
  const double thinnest = std::min(screw.tip_diameter_mm, screw.tail_diameter_mm) / 2;
  family.depth_mm = thread.number("depth_mm", 0.01, thinnest - screw.bore_radius_mm);
  family.pitch_mm = thread.number("pitch_mm", 0.1, 10.0);
  family.tip_pitch_mm = thread.number("tip_pitch_mm", 0.1, 10.0);
  family.tail_pitch_mm = thread.number("tail_pitch_mm", 0.1, 10.0);
  thread.refuse_unknown_fields();
  screw.closing_share = (family.tip_pitch_mm - family.tail_pitch_mm) / family.pitch_mm;
  screw.cut_tip_radius_mm = screw.tip_diameter_mm / 2 - family.depth_mm;
  screw.cut_tail_radius_mm = screw.tail_diameter_mm / 2 - family.depth_mm;
  screw.feed = read_feed(fields.object("feed"));
  family.material = read_material(fields);
  family.holder = &find_holder(holders, fields, fields.text("holder"));
  screw.is_confirmed = fields.boolean_or("confirmed", false);
  return family;
}

Instrument screw_of(const ScrewFamily& family, double length_mm) {
  Instrument screw = family.screw;
  std::string length = short_number(length_mm);
  screw.name += " " + length + " mm";
  for (char& c : length) c = c == '.' ? '_' : c;
  screw.id = screw.family + "_" + length;
  screw.length_mm = length_mm;
  screw.cut_length_mm = length_mm;
  const double tip = screw.tip_diameter_mm / 2;
  const double tail = screw.tail_diameter_mm / 2;
  const double crest = std::max(tip, tail);
  screw.shape = InstrumentShape(
      ThreadedCylinderShape{crest - family.depth_mm, crest, family.pitch_mm, length_mm});
  DrawnPart part;
  part.to_mm = length_mm;
  part.radius_mm = tip;
  part.end_radius_mm = tail;
  part.is_threaded = true;
  part.pitch_mm = family.tip_pitch_mm;
  part.end_pitch_mm = family.tail_pitch_mm;
  part.material = family.material;
  screw.parts = {part};
  BeamRod rod;
  rod.to_mm = length_mm;
  rod.radius_mm = tip;
  rod.end_radius_mm = tail;
  rod.bore_radius_mm = screw.bore_radius_mm;
  rod.thread_depth_mm = family.depth_mm;
  rod.thread_pitch_mm = family.pitch_mm;
  rod.material = family.material;
  screw.rods = {rod};
  hold(screw, *family.holder, length_mm);
  return screw;
}

void read_screws(JsonFields& fields, const Holders& holders, std::vector<Instrument>& all) {
  const ScrewFamily family = read_family(fields, holders);
  const nlohmann::json& lengths = fields.value("lengths_mm");
  if (!lengths.is_array() || lengths.empty()) fields.refuse("lengths_mm is no list of lengths");
  for (const double length :
       fields.numbers("lengths_mm", lengths.size(), 2 * family.screw.tail_diameter_mm, 150.0)) {
    all.push_back(screw_of(family, length));
  }
  fields.refuse_unknown_fields();
}

}  // namespace

std::vector<Instrument> read_instruments(std::string_view json, std::string_view file) {
  const nlohmann::json root = parse_json_text(json, file);
  JsonFields fields(root, std::string(file), "");
  (void)fields.text_or("doc", "-");
  (void)fields.number("schema_version", 1, 2);
  const Holders holders = read_holders(fields);
  std::vector<Instrument> all;
  if (fields.has("instruments")) {
    for (JsonFields& entry : fields.objects("instruments")) {
      all.push_back(read_instrument(entry, holders));
    }
  }
  if (fields.has("families")) {
    for (JsonFields& entry : fields.objects("families")) read_screws(entry, holders, all);
  }
  fields.refuse_unknown_fields();
  return all;
}

}  // namespace carpus::instruments
