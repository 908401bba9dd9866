// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The program `carpus`: one subcommand a verb, each in its own file. Data goes to stdout, messages
// to stderr; exit status 0, 1 when something failed, 2 when the command line was wrong.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <new>

#include "cli/attempts_command.hpp"
#include "cli/bench_journal_command.hpp"
#include "cli/bench_peers_command.hpp"
#include "cli/bench_replay_command.hpp"
#include "cli/bench_tick_command.hpp"
#include "cli/collide_command.hpp"
#include "cli/device_bench_command.hpp"
#include "cli/device_calibrate_command.hpp"
#include "cli/device_list_command.hpp"
#include "cli/device_simulate_command.hpp"
#include "cli/device_test_command.hpp"
#include "cli/export_command.hpp"
#include "cli/fluoroscopy_command.hpp"
#include "cli/hull_command.hpp"
#include "cli/kinematics_command.hpp"
#include "cli/mend_command.hpp"
#include "cli/parallel_executor.hpp"
#include "cli/pathology_command.hpp"
#include "cli/phantom_command.hpp"
#include "cli/reconstruct_command.hpp"
#include "cli/replay_command.hpp"
#include "cli/score_command.hpp"
#include "cli/segment_command.hpp"
#include "cli/serve_command.hpp"
#include "cli/simulate_command.hpp"
#include "cli/soft_tissue_command.hpp"
#include "cli/stock_command.hpp"
#include "cli/study_command.hpp"
#include "cli/thesis_command.hpp"
#include "core/error.hpp"
#include "core/version.hpp"

namespace {

constexpr int kFailed = 1;
constexpr int kUsage = 2;

void add_commands(CLI::App& app) {
  using namespace carpus::cli;
  add_phantom_command(app);
  add_stock_command(app);
  add_reconstruct_command(app);
  add_segment_command(app);
  add_mend_command(app);
  add_soft_tissue_command(app);
  add_pathology_command(app);
  add_export_command(app);
  add_kinematics_command(app);
  add_hull_command(app);
  add_collide_command(app);
  add_fluoroscopy_command(app);
  add_serve_command(app);
  add_simulate_command(app);
  add_replay_command(app);
  add_score_command(app);
  add_attempts_command(app);
  add_study_command(app);
  add_thesis_command(app);
  CLI::App* device =
      app.add_subcommand("device", "Force-feedback arms and other devices of a hand");
  device->require_subcommand(1);
  add_device_list_command(*device);
  add_device_test_command(*device);
  add_device_calibrate_command(*device);
  add_device_bench_command(*device);
  add_device_simulate_command(*device);
  CLI::App* bench = app.add_subcommand("bench", "Measure how fast things are on this machine");
  bench->require_subcommand(1);
  add_bench_tick_command(*bench);
  add_bench_journal_command(*bench);
  add_bench_peers_command(*bench);
  add_bench_replay_command(*bench);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{
      "Carpus: trainer for wrist arthroscopy and percutaneous scaphoid fixation. Not a medical "
      "device."};
  app.name("carpus");
  app.set_version_flag("--version", carpus::kProgramVersion);
  app.require_subcommand(1);
  add_commands(app);
  carpus::cli::install_tbb_executor();
  try {
    app.parse(argc, argv);
    return 0;
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : kUsage;
  } catch (const carpus::UsageError& error) {
    std::fprintf(stderr, "carpus: %s\n", error.what());
    return kUsage;
  } catch (const carpus::Error& error) {
    std::fprintf(stderr, "carpus: %s\n", error.what());
  } catch (const std::bad_alloc&) {
    std::fprintf(stderr, "carpus: out of memory; close other programs or use a smaller volume\n");
  } catch (const std::filesystem::filesystem_error& error) {
    std::fprintf(stderr, "carpus: %s: %s; check the name, the permissions and the disk\n",
                 error.path1().c_str(), error.code().message().c_str());
  } catch (const std::exception& error) {
    std::fprintf(stderr, "carpus: unexpected error: %s\n", error.what());
  }
  return kFailed;
}
