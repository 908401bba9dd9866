// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// `carpus soft-tissue`: makes ligaments, disc, cartilage and joint spaces of a case, and prints
// what came of it beside what is published.
#pragma once

namespace CLI {
class App;
}

namespace carpus::cli {

void add_soft_tissue_command(CLI::App& app);

}  // namespace carpus::cli
