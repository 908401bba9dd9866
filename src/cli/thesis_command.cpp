// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/thesis_command.hpp"

#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "case_io/atomic_folder.hpp"
#include "case_io/case_folder.hpp"
#include "cli/child_program.hpp"
#include "cli/operation_files.hpp"
#include "cli/stop_request.hpp"
#include "cli/thesis_page.hpp"
#include "cli/thesis_tables.hpp"
#include "core/error.hpp"
#include "core/version.hpp"
#include "figures/bone_pictures.hpp"
#include "figures/bounding_volumes.hpp"
#include "figures/cube_cases.hpp"
#include "figures/planar_hull_steps.hpp"
#include "records/atomic_file.hpp"

namespace carpus::cli {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

struct Arguments {
  fs::path out;
  fs::path case_folder;
  fs::path bones;
  bool no_tables = false;
  bool quick = false;
  bool no_pdf = false;
  bool force = false;
};

std::string read_text(const fs::path& file) {
  const std::vector<std::byte> bytes = records::read_file(file);
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

/// An SVG's elements, to be set into HTML.
std::string svg_of(const std::string& file_content) {
  const std::size_t begin = file_content.find("<svg");
  return begin == std::string::npos ? std::string() : file_content.substr(begin);
}

/// All of one run: figures and tables by id, and the files that stay beside the report.
class ThesisRun {
 public:
  ThesisRun(const Arguments& arguments, fs::path folder)
      : arguments_(arguments), folder_(std::move(folder)), work_(folder_ / "work") {
    fs::create_directories(folder_ / "figures");
    fs::create_directories(folder_ / "tables");
    fs::create_directories(work_);
  }

  void make() {
    const fs::path case_folder = find_case();
    step("the case", 0.30);
    const cases::CaseData data = case_io::read_case(case_folder);
    step("segmentation, slice by slice", 0.35);
    segment(case_folder);
    step("drawings", 0.45);
    draw(data);
    make_tables();
    page_.about = about(data);
    step("the report", 0.97);
    records::write_file_atomically(folder_ / "thesis.html", thesis_page(page_));
    print_pdf();
    fs::remove_all(work_);
  }

 private:
  static void step(const char* what, double fraction) { StopRequest::show_or_stop(what, fraction); }
  void child(const fs::path& program,
             const std::vector<std::string>& words,
             const std::string& name) {
    run_program(program, words, work_ / (name + ".log"));
  }

  fs::path find_case() {
    if (!arguments_.case_folder.empty()) return arguments_.case_folder;
    step("a simulated scan of a wrist with a nonunion", 0.0);
    child(own_program(), {"phantom", "--fracture", "nonunion", "--out", (work_ / "scan").string()},
          "phantom");
    step("its bones", 0.15);
    child(own_program(),
          {"reconstruct", (work_ / "scan").string(), "--out", (work_ / "case").string()},
          "reconstruct");
    return work_ / "case";
  }

  void keep(const std::string& id, const std::string& svg) {
    records::write_file_atomically(folder_ / "figures" / (id + ".svg"), svg);
    page_.shown[id] = svg_of(svg);
  }

  void segment(const fs::path& case_folder) {
    child(own_program(),
          {"segment", (case_folder / "ct.nii.gz").string(), "--out",
           (work_ / "labels.nii.gz").string(), "--pictures", (work_ / "steps").string()},
          "segment");
    const std::vector<std::pair<std::string, std::string>> pictures{
        {"figure_3_1", "1_ct.png"},
        {"figure_3_2", "2_gradient_and_markers.png"},
        {"figure_3_3", "3_watershed.png"}};
    for (const auto& [id, file] : pictures) {
      fs::copy_file(work_ / "steps" / file, folder_ / "figures" / (id + ".png"));
      page_.shown[id] = embedded_image("image/png", read_text(work_ / "steps" / file));
    }
    keep("figure_3_4", read_text(work_ / "steps" / "4_bones.svg"));
  }

  void draw(const cases::CaseData& data) {
    using figures::Facets;
    using figures::WristSide;
    const std::vector<figures::DrawnBone> bones = figures::drawn_bones(data);
    const auto bone = [&](BoneId id) -> const figures::DrawnBone* {
      for (const figures::DrawnBone& b : bones) {
        if (b.bone == id) return &b;
      }
      throw InvalidInput("the case has no " + std::string(name_of(id)) +
                         ", which the thesis draws; take a case with all fifteen bones");
    };
    keep("figure_3_5", figures::draw_cube_cases());
    keep("figure_3_6", figures::draw_wrist(bones, WristSide::Dorsal, Facets::Outlined));
    keep("figure_3_7", figures::draw_wrist(bones, WristSide::Dorsal));
    keep("figure_3_8",
         figures::draw_texture_mapping(*cases::scaphoid_parts(data).back(), data.ct.view()));
    keep("figure_3_9", figures::draw_wrist(bones, WristSide::Dorsal, Facets::Textured));
    keep("figure_3_10", figures::draw_wrist(bones, WristSide::Volar, Facets::Textured));
    const BoneId scaphoid = BoneId::Scaphoid;
    keep("figure_3_11", figures::draw_wrist(bones, WristSide::Volar, Facets::Shaded, &scaphoid));
    const std::vector<Vec2> points = figures::outline_points(*bone(scaphoid), kExamplePoints);
    keep("figure_4_1", figures::draw_gift_wrapping(points));
    keep("figure_4_2", figures::draw_quickhull(points));
    keep("figure_4_3", figures::draw_chan(points, kChanGroup));
    keep("figure_4_4", figures::draw_bones_and_hulls({bone(BoneId::Capitate), bone(BoneId::Ulna)}));
    keep("figure_4_5", figures::draw_bones_and_hulls({bone(BoneId::Metacarpal3), bone(scaphoid)}));
    keep("figure_4_6", figures::draw_bones_in_hulls(
                           {bone(BoneId::Metacarpal1), bone(BoneId::Metacarpal2),
                            bone(BoneId::Metacarpal4), bone(scaphoid), bone(BoneId::Capitate),
                            bone(BoneId::Hamate), bone(BoneId::Radius), bone(BoneId::Ulna)}));
    keep("figure_5_1", figures::draw_bounding_volumes(
                           figures::outline_points(*bone(BoneId::Capitate), kOutlinePoints)));
    keep("figure_5_2", figures::draw_bones_and_hulls({bone(BoneId::Capitate)}, Facets::Outlined));
  }

  void make_tables() {
    const std::vector<std::string> ids{"table_4_1",  "figure_4_7", "table_4_2",
                                       "figure_4_8", "table_5_1",  "figure_5_3"};
    const fs::path bench = own_program().parent_path() / "carpus-bench";
    std::string why;
    if (arguments_.no_tables) why = "--no-tables was given.";
    if (!fs::exists(bench)) {
      why =
          "carpus-bench is not beside this program; it is built where the other libraries are "
          "installed: tools/install bench, then build again.";
    }
    if (!why.empty()) {
      for (const std::string& id : ids) page_.missing[id] = why;
      return;
    }
    step("table 4.1 and figure 4.7, against other libraries", 0.50);
    table(bench, "table_4_1", {"hull", "--table", "4.1"}, "figure_4_7", "_n.svg", hull_table_html);
    step("table 4.2 and figure 4.8", 0.65);
    table(bench, "table_4_2", {"hull", "--table", "4.2"}, "figure_4_8", "_n.svg", hull_table_html);
    step("table 5.1 and figure 5.3", 0.80);
    table(bench, "table_5_1", {"collision", "--table", "5.1"}, "figure_5_3", ".svg",
          collision_table_html);
  }

  void table(const fs::path& bench,
             const std::string& id,
             std::vector<std::string> words,
             const std::string& plot_id,
             const std::string& plot_end,
             const std::function<std::string(const Json&)>& html) {
    const fs::path json = folder_ / "tables" / (id + ".json");
    const fs::path plot = work_ / plot_id;
    const bool is_hull = words[0] == "hull";
    words.insert(words.end(),
                 {"--json", json.string(), "--plot", plot.string() + (is_hull ? "" : plot_end)});
    // No wrist has a knee's counts but the parametric one, whose bones can be as fine as asked for.
    if (!arguments_.bones.empty() && id != "table_4_2") {
      words.insert(words.end(), {"--bones", arguments_.bones.string()});
    }
    if (arguments_.quick) words.insert(words.end(), {"--budget-seconds", is_hull ? "0" : "0.1"});
    try {
      child(bench, words, id);
    } catch (const IoError& error) {  // the rest of the report is worth having
      page_.missing[id] = error.what();
      page_.missing[plot_id] = "its table was not made.";
      std::fprintf(stderr, "carpus: %s\n", error.what());
      return;
    }
    page_.shown[id] = html(Json::parse(read_text(json)));
    keep(plot_id, read_text(plot.string() + plot_end));
  }

  [[nodiscard]] std::string about(const cases::CaseData& data) const {
    std::string html = "<p class=\"about\">Made by Carpus " + escaped(kProgramVersion) + " of " +
                       escaped(in_words(data)) +
                       ". Its source: " + escaped(data.provenance.source) + ".";
    if (data.provenance.simulated) {
      html +=
          " <b>This scan is simulated:</b> no patient was scanned, and its pictures show what "
          "the methods do, not what a hospital's scan would give.";
    }
    if (arguments_.quick) {
      html += " <b>--quick was given:</b> each time stands on one run and means little.";
    }
    return html + " Printed numbers are brown. Not a medical device.</p>\n";
  }

  void print_pdf() {
    if (arguments_.no_pdf) return;
    const fs::path browser = find_on_path({"chromium", "chromium-browser", "google-chrome"});
    if (browser.empty()) {
      std::fprintf(stderr,
                   "carpus: thesis.pdf is not written: no chromium on the PATH (apt install "
                   "chromium); any browser prints thesis.html\n");
      return;
    }
    std::vector<std::string> words{
        "--headless", "--disable-gpu", "--no-pdf-header-footer",
        "--user-data-dir=" + fs::absolute(work_ / "browser").string(),
        "--print-to-pdf=" + fs::absolute(folder_ / "thesis.pdf").string()};
    // Chromium's own sandbox refuses to run as root; what it opens is our page alone.
    if (::geteuid() == 0) words.emplace_back("--no-sandbox");
    words.push_back("file://" + fs::absolute(folder_ / "thesis.html").string());
    try {
      child(browser, words, "pdf");
    } catch (const IoError& error) {
      std::fprintf(stderr, "carpus: thesis.pdf is not written: %s\n", error.what());
    }
  }

  static constexpr std::size_t kExamplePoints = 72;
  static constexpr std::size_t kChanGroup = 12;
  static constexpr std::size_t kOutlinePoints = 1500;

  const Arguments& arguments_;
  fs::path folder_;
  fs::path work_;
  ThesisPage page_;
};

void run(const Arguments& arguments) {
  const StopRequest stop;
  case_io::AtomicFolder folder(
      arguments.out, arguments.force ? case_io::Overwrite::Replace : case_io::Overwrite::Refuse);
  ThesisRun(arguments, folder.staging()).make();
  folder.commit();
  std::printf("chapters 3 to 5 of the thesis anew: %s\n", (arguments.out / "thesis.html").c_str());
}

}  // namespace

void add_thesis_command(CLI::App& app) {
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command = app.add_subcommand(
      "thesis", "Make every figure and table of the thesis's chapters 3 to 5 anew, in one report");
  command->add_option("--out", arguments->out, "Folder to make: thesis.html, thesis.pdf, the files")
      ->required();
  command->add_option("--case", arguments->case_folder,
                      "Case folder to draw; default: a simulated wrist with a nonunion, made anew");
  command->add_option("--bones", arguments->bones,
                      "Folder of <bone>.ply for tables 4.1 and 5.1; default: the parametric wrist");
  command->add_flag("--quick", arguments->quick, "Time each engine once");
  command->add_flag("--no-tables", arguments->no_tables, "Leave out what is timed");
  command->add_flag("--no-pdf", arguments->no_pdf, "Leave out thesis.pdf");
  command->add_flag("--force", arguments->force, "Replace what is there");
  command->callback([arguments] { run(*arguments); });
}

}  // namespace carpus::cli
