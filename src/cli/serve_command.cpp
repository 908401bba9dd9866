// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/serve_command.hpp"

#include <CLI/CLI.hpp>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>

#include "case_io/glb.hpp"
#include "cli/operation_files.hpp"
#include "core/error.hpp"
#include "procedures/built_in.hpp"
#include "records/attempt_keeper.hpp"
#include "server/network_server.hpp"
#include "server/station.hpp"
#include "server/station_http.hpp"

namespace carpus::cli {
namespace {

namespace fs = std::filesystem;

struct ServeArguments {
  std::string case_folder = kDefaultCase;
  std::string records = kDefaultRecords;
  std::uint16_t port = 8080;
  std::string listen = "127.0.0.1";
  std::string web;
};

/// The page beside the program: in the build tree (build/<preset>/bin/carpus) or installed
/// (bin/carpus and share/carpus/web).
fs::path find_web_root() {
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error).parent_path();
  for (const char* place : {"../../../web/dist", "../share/carpus/web"}) {
    if (fs::is_regular_file(program / place / "index.html", error)) return program / place;
  }
  throw InvalidInput(
      "the page was not found beside the program; build it (./run --build-only) or name its folder "
      "with --web");
}

void make_parent_folder(const fs::path& file) {
  if (file.parent_path().empty()) return;
  std::error_code error;
  fs::create_directories(file.parent_path(), error);
  if (error) {
    throw IoError(file.parent_path().string() + ": the folder for the records cannot be made: " +
                  error.message() + "; choose another file with --records");
  }
}

void log_line(const std::string& line) { std::fprintf(stderr, "carpus: %s\n", line.c_str()); }

void run(const ServeArguments& arguments) {
  const fs::path web = arguments.web.empty() ? find_web_root() : fs::path(arguments.web);
  make_parent_folder(arguments.records);
  records::AttemptKeeper records(arguments.records);
  const cases::CaseData data = load_case(arguments.case_folder);
  const procedure::ProcedureList& procedures = procedures::built_in();
  const server::StationHttp http(data, procedures, case_io::make_case_glb(data), records, web);
  server::Station station(data, procedures, records, log_line);
  server::NetworkOptions options;
  options.address = arguments.listen;
  options.port = arguments.port;
  server::NetworkServer network(
      options, [&http](const server::HttpRequest& request) { return http.answer(request); },
      station);
  station.attach(network);
  network.stop_on_signals();
  std::printf("Carpus is ready: %s  (case '%s'%s; Ctrl+C stops)\n", network.url().c_str(),
              data.pseudonym.c_str(), data.provenance.simulated ? ", simulated" : "");
  std::fflush(stdout);
  if (options.address != "127.0.0.1" && options.address != "::1") {
    log_line("every machine that reaches " + options.address +
             " can operate and read the records: there is no password");
  }
  network.run();
  station.detach();
  if (records.waiting() > 0) {
    throw IoError(std::to_string(records.waiting()) + " attempts could not be stored in " +
                  arguments.records + "; the messages above say where they are");
  }
}

}  // namespace

void add_serve_command(CLI::App& app) {
  auto arguments = std::make_shared<ServeArguments>();
  CLI::App* command = app.add_subcommand("serve", "Serve the trainer to a browser");
  command->add_option("--case", arguments->case_folder, "Case folder to operate on")
      ->capture_default_str();
  command->add_option("--records", arguments->records, "File for the attempts")
      ->capture_default_str();
  command->add_option("--port", arguments->port, "Port to listen on; 0 takes a free one")
      ->capture_default_str();
  command->add_option("--listen", arguments->listen, "IP address to listen on")
      ->capture_default_str();
  command->add_option("--web", arguments->web, "Folder of the built page");
  command->callback([arguments] { run(*arguments); });
}

}  // namespace carpus::cli
