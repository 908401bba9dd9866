// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "stock/stock_list.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "core/json_fields.hpp"

namespace carpus::data {
std::string_view stock();
}  // namespace carpus::data

namespace carpus::stock {
namespace {

constexpr std::array<std::string_view, 2> kSides{"left", "right"};
constexpr std::array<std::string_view, 3> kSizes{"small", "average", "large"};
constexpr double kMostSeed = 1e9;

StockItem read_item(JsonFields fields) {
  StockItem item;
  item.id = fields.text("id");
  const bool is_plain = std::all_of(item.id.begin(), item.id.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_';
  });
  if (!is_plain) fields.refuse("id is not of a-z, 0-9 and _");
  item.lesson.title = fields.text("title");
  item.lesson.history = fields.text("history");
  item.lesson.goal = fields.text("goal");
  std::vector<std::string_view> kinds;
  for (const phantom::FractureKind kind : phantom::kAllFractureKinds) {
    kinds.push_back(name_of(kind));
  }
  item.wrist.fracture = phantom::kAllFractureKinds[fields.choice("fracture", kinds)];
  item.wrist.side = fields.choice("side", kSides) == 0 ? Side::Left : Side::Right;
  item.wrist.scale = fields.number("scale", 0.7, 1.4);
  item.lesson.size = kSizes[fields.choice("size", kSizes)];
  item.wrist.seed = static_cast<std::uint64_t>(fields.number("seed", 0, kMostSeed));
  item.lesson.right_answer =
      static_cast<cases::RightAnswer>(fields.choice("right_answer", cases::kRightAnswers));
  item.lesson.reason = fields.text("reason");
  item.lesson.decline_for = fields.texts_or_none("decline_for");
  fields.refuse_unknown_fields();
  return item;
}

}  // namespace

std::vector<StockItem> read_stock_list(std::string_view json, std::string_view file) {
  const nlohmann::json value = parse_json_text(json, file);
  JsonFields fields(value, std::string(file), "stock");
  (void)fields.text_or("doc", "");
  (void)fields.number("schema_version", 1, 1);
  std::vector<StockItem> items;
  for (JsonFields& each : fields.objects("cases")) {
    StockItem item = read_item(each);
    for (const StockItem& other : items) {
      if (other.id == item.id) fields.refuse("id '" + item.id + "' comes twice");
    }
    items.push_back(std::move(item));
  }
  fields.refuse_unknown_fields();
  return items;
}

std::span<const StockItem> stock_list() {
  static const std::vector<StockItem> list = read_stock_list(data::stock(), "stock.json");
  return list;
}

}  // namespace carpus::stock
