// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/imaging/peer_vtk.hpp"

#include <stdlib.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>

#include "core/error.hpp"

namespace carpus::bench {
namespace {

namespace fs = std::filesystem;

struct ScratchFolder {
  ScratchFolder() {
    std::string name = (fs::temp_directory_path() / "carpus_vtk_XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr) throw IoError(name + ": cannot be made");
    path = name;
  }
  ~ScratchFolder() {
    std::error_code ignored;
    fs::remove_all(path, ignored);
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  fs::path path;
};

}  // namespace

std::optional<SurfacesRun> run_vtk_surfaces(const Volume& volume,
                                            const std::vector<std::uint16_t>& labels,
                                            std::uint16_t last) {
  const ScratchFolder scratch;
  const fs::path file = scratch.path / "labels.raw";
  std::ofstream out(file, std::ios::binary);
  out.write(reinterpret_cast<const char*>(labels.data()),
            static_cast<std::streamsize>(labels.size() * sizeof(labels[0])));
  out.close();
  if (!out) throw IoError(file.string() + ": cannot be written whole; free some space");
  // Debian's own interpreter: another one has no VTK.
  std::string command =
      "/usr/bin/python3 '" CARPUS_BENCH_SOURCE "/imaging/vtk_surfaces.py' '" + file.string() + "'";
  for (const int n : volume.size) command += " " + std::to_string(n);
  command += " " + std::to_string(volume.spacing_mm[0]) + " " + std::to_string(last) + " 2>&1";
  const std::unique_ptr<FILE, int (*)(FILE*)> pipe(::popen(command.c_str(), "r"), ::pclose);
  SurfacesRun run;
  if (pipe == nullptr ||
      std::fscanf(pipe.get(), "%lf %zu %zu", &run.seconds, &run.vertices, &run.facets) != 3) {
    return std::nullopt;
  }
  return run;
}

}  // namespace carpus::bench
