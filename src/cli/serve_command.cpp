// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/serve_command.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "case_io/glb.hpp"
#include "case_io/pathology_file.hpp"
#include "case_io/soft_tissue_folder.hpp"
#include "cli/case_pathology.hpp"
#include "cli/child_program.hpp"
#include "cli/find_cases.hpp"
#include "cli/new_case_maker.hpp"
#include "cli/operation_files.hpp"
#include "core/error.hpp"
#include "devices/device_catalogue.hpp"
#include "procedures/built_in.hpp"
#include "reconstruct/limb_beyond_scan.hpp"
#include "records/atomic_file.hpp"
#include "records/attempt_keeper.hpp"
#include "server/access_links.hpp"
#include "server/asset_desk.hpp"
#include "server/log_writer.hpp"
#include "server/network_server.hpp"
#include "server/new_case_desk.hpp"
#include "server/pathology_desk.hpp"
#include "server/station.hpp"
#include "server/station_http.hpp"

namespace carpus::cli {
namespace {

namespace fs = std::filesystem;

struct ServeArguments {
  std::vector<std::string> cases{kDefaultCase};
  std::string records = kDefaultRecords;
  std::uint16_t port = 8080;
  std::string listen = "127.0.0.1";
  std::string web;
  bool open = false;
  bool no_devices = false;
  bool new_links = false;
  std::string link_file;
  std::string certificate;
  std::string key;
  std::string public_url;
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

bool is_for_this_machine(const ServeArguments& arguments) {
  return (arguments.listen == "127.0.0.1" || arguments.listen == "::1") &&
         arguments.public_url.empty();
}

server::NetworkOptions network_options(const ServeArguments& arguments) {
  server::NetworkOptions options;
  options.address = arguments.listen;
  options.port = arguments.port;
  options.certificate = arguments.certificate;
  options.key = arguments.key;
  options.public_url = arguments.public_url;
  if (arguments.open) {
    if (is_for_this_machine(arguments)) return options;
    throw UsageError(
        "--open lets everybody in, so it is for this machine alone; leave it out, and hand on the "
        "links that are printed, or leave out --listen and --public-url");
  }
  // Beside the records: whoever may read those needs no link.
  options.links = server::keep_access_links(fs::path(arguments.records).replace_extension(".links"),
                                            arguments.new_links);
  return options;
}

std::string link(const std::string& url, const std::string& token) {
  return url + "/?token=" + token;
}

/// A page that leads on to the link: unlike an argument, others cannot see it in a list of
/// processes.
class LinkFile {
 public:
  LinkFile(fs::path file, const std::string& target) : file_(std::move(file)) {
    if (file_.empty()) return;
    const ::mode_t before = ::umask(0077);
    const std::string page =
        "<!doctype html><meta http-equiv=\"refresh\" content=\"0;url=" + target +
        "\"><title>Carpus</title>\n";
    try {
      records::write_file_atomically(file_, page);
    } catch (...) {
      ::umask(before);
      throw;
    }
    ::umask(before);
  }
  ~LinkFile() {
    std::error_code ignored;
    if (!file_.empty()) fs::remove(file_, ignored);
  }
  LinkFile(const LinkFile&) = delete;
  LinkFile& operator=(const LinkFile&) = delete;

 private:
  fs::path file_;
};

void say_ready(const ServeArguments& arguments,
               const server::NetworkOptions& options,
               const std::string& url,
               const cases::CaseData& data,
               const server::Log& log_line) {
  const std::string about = "(case '" + data.pseudonym +
                            (data.provenance.simulated ? "', simulated" : "'") + "; Ctrl+C stops)";
  if (!options.links) {
    std::printf("Carpus is ready: %s  %s\n", url.c_str(), about.c_str());
  } else if (is_for_this_machine(arguments)) {
    std::printf("Carpus is ready: %s  %s\n", link(url, options.links->instructor).c_str(),
                about.c_str());
  } else {
    std::printf("Carpus is ready: %s  %s\n", url.c_str(), about.c_str());
    std::printf("  for trainees:    %s\n", link(url, options.links->trainee).c_str());
    std::printf("  for instructors: %s\n", link(url, options.links->instructor).c_str());
    if (url.starts_with("http://")) {
      log_line(
          "what is said on this network is not enciphered, the links included: give --certificate "
          "and --key, or put a proxy before it (docs/network.md)");
    }
  }
  std::fflush(stdout);
}

/// Which case was open last, beside the records: what a killed station left is of that one.
class OpenCase {
 public:
  OpenCase(std::shared_ptr<server::SharedShelf> shelf, const fs::path& records)
      : shelf_(std::move(shelf)), file_(fs::path(records).replace_extension(".case")) {
    std::ifstream in(file_);
    std::string id;
    if (std::getline(in, id) && shelf_->now()->find(id) != nullptr) open(id);
  }
  void choose(const std::string& id) {
    records::write_file_atomically(file_, id + "\n");
    open(id);
  }
  [[nodiscard]] fs::path folder() const {
    const auto shelf = shelf_->now();
    return shelf->find(shelf->open)->folder;
  }

 private:
  void open(const std::string& id) {
    shelf_->change([&](server::CaseShelf& shelf) { shelf.open = id; });
  }
  std::shared_ptr<server::SharedShelf> shelf_;
  fs::path file_;
};

/// Those that pages have made, beside the records like all that pages make.
fs::path made_cases(const ServeArguments& arguments) {
  return fs::path(arguments.records).replace_extension(".cases");
}

FoundCases find_all_cases(const ServeArguments& arguments) {
  std::vector<std::string> places = arguments.cases;
  const fs::path made = made_cases(arguments);
  std::error_code error;
  for (fs::directory_iterator at(made, error), end; !error && at != end; at.increment(error)) {
    if (fs::is_regular_file(at->path() / "case.json")) places.push_back(at->path());
  }
  std::sort(places.begin() + static_cast<std::ptrdiff_t>(arguments.cases.size()), places.end());
  return find_cases(places);
}

/// What stays while cases come and go.
struct Station {
  const ServeArguments& arguments;
  server::NetworkOptions& options;
  records::AttemptKeeper& records;
  const server::Log& log_line;
  fs::path web;
  std::shared_ptr<server::TruthGate> truth;
  std::shared_ptr<server::SharedShelf> shelf;
  server::NewCaseDesk& new_cases;
  std::shared_ptr<server::AttemptOwners> owners = std::make_shared<server::AttemptOwners>();
  std::shared_ptr<server::AttemptOwners> quiz_owners = std::make_shared<server::AttemptOwners>();
  server::AssetDesk asset{records, *owners};
  server::PathologyDesk pathology{shelf, truth, {case_io::read_pathology, write_pathology}};
};

/// The operation does not wait for what only devices need.
void offer_devices(server::Station& station, const server::Log& log_line) {
  try {
    station.offer_devices(devices::search_here());
  } catch (const Error& error) {
    log_line(std::string("no devices are offered: ") + error.what());
  }
}

/// With the limb beyond the scan, and the inside of the joint where the case has soft tissue.
std::string scene_of(const cases::CaseData& data, const fs::path& folder) {
  const reconstruct::LimbBeyondScan limb = reconstruct::limb_beyond_scan(data);
  std::array<case_io::NamedMesh, 2> besides{
      {{"limb_hand", &limb.hand, {}, anatomy::Tissue::Skin},
       {"limb_forearm", &limb.forearm, {}, anatomy::Tissue::Skin}}};
  for (case_io::NamedMesh& each : besides) each.is_generated = true;
  const auto tissue = case_io::read_soft_tissue(folder);
  if (!tissue) return case_io::make_case_glb(data, {}, besides);
  return case_io::make_case_glb(data, arthroscopy::make_joint_walls(data, *tissue), besides);
}

/// Serves the open case until it is stopped, or another is chosen: returns that one's id, or "".
std::string serve_one(Station& s, const cases::CaseData& data, const fs::path& folder) {
  const procedure::ProcedureList& procedures = procedures::built_in();
  std::string chosen;
  std::function<void()> stop;
  const auto choose = [&](const std::string& id) {
    if (s.shelf->now()->find(id) == nullptr) return false;
    chosen = id;
    stop();
    return true;
  };
  server::Station station(data, procedures, s.records, s.log_line, {},
                          {choose, s.owners, s.quiz_owners, s.truth,
                           [folder] { return case_io::read_pathology(folder); }});
  if (!s.arguments.no_devices) offer_devices(station, s.log_line);
  const server::StationHttp http(data, procedures, scene_of(data, folder), s.records,
                                 {station.owners(), station.quiz_owners()}, s.web, s.shelf,
                                 s.truth);
  server::NetworkServer network(
      s.options,
      [&](const server::HttpRequest& request) {
        if (server::NewCaseDesk::is_for(request)) return s.new_cases.answer(request);
        if (server::PathologyDesk::is_for(request)) return s.pathology.answer(request);
        return server::AssetDesk::is_for(request) ? s.asset.answer(request) : http.answer(request);
      },
      station);
  network.repeat(std::chrono::seconds(1), [&s] { s.new_cases.tend(); });
  stop = [&network] { network.stop(); };
  network.stop_on_signals();
  station.attach(network);
  s.options.port = network.port();  // the next case is where this one was
  const std::string url = network.url();
  const LinkFile link_file(s.arguments.link_file,
                           s.options.links ? link(url, s.options.links->instructor) : url);
  say_ready(s.arguments, s.options, url, data, s.log_line);
  network.run();
  station.detach();
  return chosen;
}

void run(const ServeArguments& arguments) {
  const fs::path web = arguments.web.empty() ? find_web_root() : fs::path(arguments.web);
  make_parent_folder(arguments.records);
  server::NetworkOptions options = network_options(arguments);
  server::require_network(options);
  const auto shelf = std::make_shared<server::SharedShelf>(find_all_cases(arguments).shelf);
  server::LogWriter log(STDERR_FILENO);
  const server::Log log_line = [&log](const std::string& line) { log.write("carpus: " + line); };
  records::AttemptKeeper records(arguments.records, log_line);
  OpenCase open(shelf, arguments.records);
  const auto truth = std::make_shared<server::TruthGate>();
  fs::create_directories(made_cases(arguments));
  const NewCaseMaker maker(own_program(), made_cases(arguments), shelf);
  server::NewCaseOptions desk_options;
  desk_options.make = [&maker](const auto& task, const auto& progress, const auto& stop) {
    return maker.make(task, progress, stop);
  };
  desk_options.incoming = fs::path(arguments.records).replace_extension(".incoming");
  desk_options.truth = truth;
  server::NewCaseDesk new_cases(std::move(desk_options));
  Station station{arguments, options, records, log_line, web, truth, shelf, new_cases};
  options.lane_of = [](const server::HttpRequest& request) {
    return server::NewCaseDesk::is_for(request) ? server::NetworkOptions::kLanes
                                                : server::StationHttp::lane_of(request);
  };
  options.take_body = [&station](const server::HttpRequest& request, std::uint64_t bytes) {
    if (server::PathologyDesk::is_for(request)) return station.pathology.take_body(request, bytes);
    return server::AssetDesk::is_for(request) ? station.asset.take_body(request, bytes)
                                              : station.new_cases.take_body(request, bytes);
  };
  cases::CaseData data = load_case(open.folder());
  while (true) {
    const std::string chosen = serve_one(station, data, open.folder());
    if (chosen.empty()) break;
    try {
      data = load_case(shelf->now()->find(chosen)->folder);
      open.choose(chosen);
    } catch (const Error& error) {
      log_line(std::string("the case stays as it was: ") + error.what());
    }
  }
  if (const std::size_t waiting = records.settle(); waiting > 0) {
    throw IoError(std::to_string(waiting) + " attempts could not be stored in " +
                  arguments.records + "; the messages above say where they are");
  }
}

}  // namespace

void add_serve_command(CLI::App& app) {
  auto arguments = std::make_shared<ServeArguments>();
  CLI::App* command = app.add_subcommand("serve", "Serve the trainer to a browser");
  command
      ->add_option("--case", arguments->cases,
                   "Case folder to operate on, or a folder of them; several times for a choice")
      ->capture_default_str();
  command->add_option("--records", arguments->records, "File for the attempts")
      ->capture_default_str();
  command->add_option("--port", arguments->port, "Port to listen on; 0 takes a free one")
      ->capture_default_str();
  command
      ->add_option("--listen", arguments->listen,
                   "IP address to listen on; 0.0.0.0 is the whole network")
      ->capture_default_str();
  command->add_flag("--open", arguments->open,
                    "Let everybody on this machine in, without the link's token");
  command->add_flag("--no-devices", arguments->no_devices,
                    "Offer none of this machine's devices to the page");
  command->add_flag("--new-links", arguments->new_links,
                    "Make new links; whoever came in by the old ones is out");
  command->add_option("--link-file", arguments->link_file,
                      "Write a page here, readable by its owner alone, that opens the link");
  command->add_option("--certificate", arguments->certificate,
                      "Speak TLS with this certificate (PEM, its chain behind it)");
  command->add_option("--key", arguments->key, "The certificate's key (PEM, no pass phrase)");
  command->add_option("--public-url", arguments->public_url,
                      "What people open where a proxy stands before this station, such as "
                      "https://train.example.org");
  command->add_option("--web", arguments->web, "Folder of the built page");
  command->callback([arguments] { run(*arguments); });
}

}  // namespace carpus::cli
