// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// carpus-bench: our algorithms against the best peers on this machine. `carpus bench` starts it.
#include <CLI/CLI.hpp>
#include <cstdio>

#include "bench/collision/command.hpp"
#include "bench/fluoroscopy/command.hpp"
#include "bench/hull/command.hpp"
#include "bench/imaging/command.hpp"

int main(int argc, char** argv) {
  CLI::App app{"carpus-bench: our algorithms against the best peers, in one run"};
  app.require_subcommand(1);
  carpus::bench::HullArguments hull;
  carpus::bench::add_hull(app, hull);
  carpus::bench::FluoroscopyArguments fluoroscopy;
  carpus::bench::add_fluoroscopy(app, fluoroscopy);
  carpus::bench::ImagingArguments imaging;
  carpus::bench::add_imaging(app, imaging);
#ifdef CARPUS_HAS_COLLISION_BENCH
  carpus::bench::CollisionArguments collision;
  carpus::bench::add_collision(app, collision);
#endif
  try {
    app.parse(argc, argv);
    return 0;
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "carpus-bench: %s\n", error.what());
    return 1;
  }
}
