// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/device_list_command.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "cli/device_choice.hpp"
#include "cli/output_file.hpp"
#include "records/atomic_file.hpp"

namespace carpus::cli {
namespace {

struct ListArguments {
  std::string json;
  bool quick = false;
};

/// Each in its own loop, all at once, until it is known how it is.
nlohmann::ordered_json look_at(const std::vector<devices::FoundDevice>& found,
                               const devices::DeviceSearch& search) {
  std::vector<std::unique_ptr<devices::HostLoop>> loops;
  for (const devices::FoundDevice& one : found) {
    loops.push_back(std::make_unique<devices::HostLoop>(devices::make_device(one.id, search)));
  }
  auto rows = nlohmann::ordered_json::array();
  for (std::size_t i = 0; i < found.size(); ++i) {
    devices::LoopState state;
    wait_until(*loops[i], state, kStartSeconds, [](const devices::LoopState& now) {
      return now.device.health != devices::Health::Closed &&
             now.device.health != devices::Health::Starting;
    });
    nlohmann::ordered_json row{{"id", found[i].id},
                               {"name", found[i].name},
                               {"health", devices::in_words(state.device.health)},
                               {"what_to_do", health_in_words(*loops[i], state)},
                               {"can", devices::in_words(state.able)},
                               {"peak_force_n", state.able.peak_force_n}};
    if (state.device.has_unit) row["unit"] = state.device.unit;
    rows.push_back(std::move(row));
  }
  return rows;
}

void run(const ListArguments& arguments) {
  const devices::DeviceSearch search = devices::search_here();
  const std::vector<devices::FoundDevice> found = devices::find_devices(search);
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  if (arguments.quick) {
    for (const auto& one : found) rows.push_back({{"id", one.id}, {"name", one.name}});
  } else {
    rows = look_at(found, search);
  }
  for (const auto& row : rows) {
    std::printf("%s  (%s)\n", row["id"].get<std::string>().c_str(),
                row["name"].get<std::string>().c_str());
    if (arguments.quick) continue;
    std::printf("  %s\n  %s\n", row["what_to_do"].get<std::string>().c_str(),
                row["can"].get<std::string>().c_str());
  }
  if (found.empty()) {
    std::printf(
        "No device is found.\n"
        "  A serial arm: plug it in; add yourself to the group 'dialout', then log in anew.\n"
        "  A SpaceMouse: install spacenavd. A gamepad: add yourself to the group 'input'.\n"
        "  A Haply: start its service, and use --device haply.\n"
        "  Nothing at hand: 'carpus device simulate' in another terminal.\n"
        "Mouse, touch, gamepad and keyboard work in the page without any of this "
        "(docs/devices.md).\n");
  }
  if (!arguments.json.empty()) {
    records::write_file_atomically(arguments.json,
                                   nlohmann::ordered_json{{"devices", rows}}.dump(2) + "\n");
  }
}

}  // namespace

void add_device_list_command(CLI::App& device) {
  auto arguments = std::make_shared<ListArguments>();
  CLI::App* command =
      device.add_subcommand("list", "Show the devices that are there, and how they are");
  command->add_flag("--quick", arguments->quick, "Names alone: nothing is opened");
  command->add_option("--json", arguments->json, "Write what is found to this file")
      ->check(output_file());
  command->callback([arguments] { run(*arguments); });
}

}  // namespace carpus::cli
