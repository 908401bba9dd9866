// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// `carpus hull`: the convex hull of a surface, a point set, or points in the plane.
#pragma once

namespace CLI {
class App;
}

namespace carpus::cli {

/// Registers the subcommand; its callback throws carpus::Error where it fails.
void add_hull_command(CLI::App& app);

}  // namespace carpus::cli
