// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/reconstruct_command.hpp"

#include <sys/resource.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "case_io/case_folder.hpp"
#include "case_io/lesson_file.hpp"
#include "case_io/read_volume.hpp"
#include "case_io/soft_tissue_folder.hpp"
#include "case_io/trust_file.hpp"
#include "cli/corrected_case.hpp"
#include "cli/progress_line.hpp"
#include "cli/series_choice.hpp"
#include "cli/simulated_scan.hpp"
#include "cli/soft_tissue_report.hpp"
#include "cli/write_structures.hpp"
#include "core/error.hpp"
#include "core/parallel.hpp"
#include "core/person_name.hpp"
#include "core/version.hpp"
#include "reconstruct/given_labels_file.hpp"
#include "reconstruct/reconstruct_case.hpp"
#include "reconstruct/reconstruction_report.hpp"
#include "records/atomic_file.hpp"
#include "soft_tissue/make_soft_tissue.hpp"
#include "stock/case_picture.hpp"

namespace carpus::cli {
namespace {

namespace fs = std::filesystem;

struct Arguments {
  fs::path input;
  fs::path out;
  fs::path truth;
  fs::path true_surfaces;
  fs::path labels;
  fs::path names;
  fs::path json;
  std::string series;
  fs::path list_series;
  std::string pseudonym = "wrist";
  bool has_pseudonym = false;
  bool simulated = false;
  bool force = false;
};

void warn(const std::string& text) { std::fprintf(stderr, "carpus: warning: %s\n", text.c_str()); }

std::string utc_now() {
  const std::time_t now = std::time(nullptr);
  std::tm utc{};
  gmtime_r(&now, &utc);
  std::array<char, 32> text{};
  std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%SZ", &utc);
  return text.data();
}

double peak_memory_bytes() {
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  return 1024.0 * static_cast<double>(usage.ru_maxrss);
}

/// What each stage of the work has brought the program's memory to.
class StagePeaks {
 public:
  void begin(std::string_view stage) {
    if (stage == current_) return;
    end();
    current_ = stage;
  }
  void end() { peaks_[current_] = peak_memory_bytes(); }
  void put_into(std::vector<reconstruct::StageTime>& stages) const {
    for (reconstruct::StageTime& stage : stages) {
      const auto found = peaks_.find(stage.name);
      if (found != peaks_.end()) stage.peak_memory_bytes = found->second;
    }
  }

 private:
  std::string current_ = "read";
  std::map<std::string, double> peaks_;
};

/// Said before minutes of work, and never deletes a folder that is not a case.
void check_target(const Arguments& a) {
  if (!fs::exists(a.out)) return;
  if (!fs::is_directory(a.out)) {
    throw IoError(a.out.string() + ": is a file; give a folder for the case with --out");
  }
  if (fs::is_empty(a.out)) return;
  if (!a.force) {
    throw IoError(a.out.string() + ": exists; give another folder or --force to replace the case");
  }
  if (!fs::exists(a.out / "case.json")) {
    throw IoError(a.out.string() +
                  ": is not empty and holds no case.json, so --force does not replace it; give "
                  "another folder");
  }
}

std::string source_in_words(const Arguments& a, const GridGeometry& g, bool simulated) {
  const bool volume_file = !fs::is_directory(a.input) && a.input.extension() != ".dcm";
  std::array<char, 160> text{};
  std::snprintf(text.data(), text.size(), "%s%s of %d x %d x %d voxels of %.3g x %.3g x %.3g mm",
                simulated ? "simulated " : "", volume_file ? "CT volume" : "CT series", g.size[0],
                g.size[1], g.size[2], g.spacing.x, g.spacing.y, g.spacing.z);
  return text.data();
}

/// After the case is whole: what no CT shows. The case is a case without it. Tendons, arteries and
/// nerves give way to it: what is told of them is of where they lie then.
std::string generate_soft_tissue(reconstruct::Reconstruction& result, const fs::path& folder) {
  show_progress("soft tissue", 0);
  cases::CaseData& data = result.data;
  const soft_tissue::SoftTissue tissue = soft_tissue::make_soft_tissue_moving_structures(data);
  const std::vector<std::string> told = std::move(result.structures.problems);
  result.structures = cases::measure_structures(data);
  for (const std::string& problem : result.structures.problems) {
    const bool is_new = std::find(told.begin(), told.end(), problem) == told.end();
    if (is_new) warn("generated structures: " + problem);
  }
  for (const std::string& problem : tissue.problems) warn("generated soft tissue: " + problem);
  write_structures(data, folder);
  case_io::write_soft_tissue(tissue, data, folder);
  show_progress("done", 1);
  return soft_tissue_line(tissue);
}

case_io::Trust trust_of(const reconstruct::Reconstruction& result) {
  case_io::Trust told{{}, result.of_scan};
  for (std::size_t i = 0; i < result.data.bones.size(); ++i) {
    const cases::Bone& bone = result.data.bones[i];
    const reconstruct::BoneTrust& trust = result.figures[i].trust;
    told.bones.push_back(
        {std::string(name_of(bone.bone, bone.part)), trust.confidence, trust.flagged, trust.why});
  }
  return told;
}

reconstruct::Reconstruction make_case(const Arguments& a,
                                      Grid<std::int16_t> ct,
                                      reconstruct::ReconstructOptions& options) {
  if (a.labels.empty()) return reconstruct::reconstruct_case(std::move(ct), options);
  const Grid<std::uint8_t> labels =
      reconstruct::read_given_labels(a.labels, a.names, ct.geometry(), warn);
  std::vector<std::string>& said = options.provenance.conventions;
  if (!is_case_folder(a.input)) {
    said.emplace_back("bones as outlined and named in a given label volume");
    return reconstruct::reconstruct_labelled(std::move(ct), labels, options);
  }
  const EarlierCase earlier = read_earlier_case(a.input);
  reconstruct::require_same_grid(ct.geometry(), earlier.version.labels.geometry(),
                                 "the earlier case");
  const std::vector<std::string> changes = changes_between(earlier.version.labels, labels);
  if (changes.empty()) {
    throw InvalidInput("the labels are those that the case has already; nothing would change");
  }
  if (!a.has_pseudonym) options.pseudonym = earlier.pseudonym;
  options.provenance.simulated = options.provenance.simulated || earlier.provenance.simulated;
  options.provenance.source = earlier.provenance.source;
  options.provenance.version_of = earlier.id;
  said = earlier.provenance.conventions;
  for (const std::string& change : changes) said.push_back("corrected by a person, " + change);
  return reconstruct::reconstruct_labelled(std::move(ct), labels, options, &earlier.version);
}

/// The scan of a case is in its folder beside the labels.
fs::path scan_of(const Arguments& a) {
  if (!is_case_folder(a.input)) return a.input;
  if (a.labels.empty()) {
    throw UsageError(a.input.string() +
                     " is a case: give its corrected bones with --labels for a new version of it, "
                     "or its ct.nii.gz to make it anew");
  }
  return a.input / "ct.nii.gz";
}

Grid<std::int16_t> read_scan(const Arguments& a,
                             const fs::path& scan,
                             const case_io::ReadOptions& reading) {
  try {
    return case_io::read_ct(scan, reading);
  } catch (const case_io::SeveralSeries& several) {
    if (!a.list_series.empty()) {
      records::write_file_atomically(a.list_series, series_choice_text(several.volumes()));
    }
    throw;
  }
}

void run(const Arguments& a) {
  if (!a.names.empty() && a.labels.empty()) {
    throw UsageError("--names says what the numbers of --labels are; give those too");
  }
  check_target(a);
  const auto started = reconstruct::StageClock::Clock::now();
  show_progress("read", 0);
  case_io::ReadOptions reading;
  reading.series_uid = a.series;
  reading.warn = warn;
  std::vector<std::string> conventions;
  reading.note = [&](const std::string& text) { conventions.push_back(text); };
  const fs::path scan = scan_of(a);
  Grid<std::int16_t> ct = read_scan(a, scan, reading);
  reconstruct::GroundTruth truth;
  if (!a.truth.empty()) {
    truth = reconstruct::read_ground_truth(a.truth);
    reconstruct::require_same_grid(ct.geometry(), truth);
  }
  std::vector<reconstruct::TrueSurface> true_surfaces;
  if (!a.true_surfaces.empty()) {
    true_surfaces = reconstruct::read_true_surfaces(a.true_surfaces);
  }
  const double reading_seconds = reconstruct::StageClock::seconds_since(started);

  reconstruct::ReconstructOptions options;
  if (const auto problem = problem_of_name(a.pseudonym))
    throw UsageError("--pseudonym: " + *problem);
  options.pseudonym = a.pseudonym;
  options.provenance.simulated = a.simulated || is_simulated_scan(scan, a.series);
  options.provenance.source = source_in_words(a, ct.geometry(), options.provenance.simulated);
  options.provenance.made_by = kProgramVersion;
  options.provenance.made_at = utc_now();
  options.provenance.conventions = conventions;
  StagePeaks peaks;
  options.progress = [&](std::string_view stage, double fraction) {
    peaks.begin(stage);
    show_progress(stage, fraction);
  };
  reconstruct::Reconstruction result = make_case(a, std::move(ct), options);
  for (const std::string& text : result.warnings) warn(text);

  std::vector<reconstruct::SurfaceDistance> surfaces;
  if (!true_surfaces.empty()) {
    surfaces = reconstruct::compare_surfaces(result.data, true_surfaces);
  }
  std::vector<reconstruct::LabelDice> dice;
  if (!a.truth.empty()) dice = reconstruct::compare_labels(result.data.labels.view(), truth);
  peaks.begin("write");
  const auto writing = reconstruct::StageClock::Clock::now();
  std::string picture;
  side_by_side({[&] {
                  case_io::write_case(
                      result.data, a.out,
                      a.force ? case_io::Overwrite::Replace : case_io::Overwrite::Refuse);
                },
                [&] { picture = stock::case_picture(result.data); }});
  records::write_file_atomically(
      a.out / case_io::kTrustFile,
      case_io::trust_text(trust_of(result), result.data.provenance.made_by));
  // After what is flagged: a disk that fills up costs the picture first.
  records::write_file_atomically(a.out / case_io::kPreviewFile, picture);
  result.stages.insert(result.stages.begin(), {"read", reading_seconds});
  result.stages.push_back({"write", reconstruct::StageClock::seconds_since(writing)});
  peaks.begin("soft tissue");
  const auto generating = reconstruct::StageClock::Clock::now();
  const std::string soft_tissue = generate_soft_tissue(result, a.out);
  result.stages.push_back({"soft tissue", reconstruct::StageClock::seconds_since(generating)});
  peaks.end();
  peaks.put_into(result.stages);
  reconstruct::ReconstructionReport report = reconstruct::make_report(result, dice, surfaces);
  report.peak_memory_bytes = peak_memory_bytes();
  std::fputs(reconstruct::text_of(report).c_str(), stdout);
  std::printf("soft tissue (generated, not seen in the CT): %s\n", soft_tissue.c_str());
  std::printf("case: %s%s\n", a.out.string().c_str(),
              result.data.provenance.simulated ? " (simulated)" : "");
  // After minutes of work the figures are on the terminal even where the file cannot be written.
  if (!a.json.empty()) records::write_file_atomically(a.json, reconstruct::json_of(report));
}

}  // namespace

void add_reconstruct_command(CLI::App& app) {
  auto a = std::make_shared<Arguments>();
  CLI::App* command =
      app.add_subcommand("reconstruct", "Make a case of a CT: bones, names, surfaces, hulls");
  command
      ->add_option(
          "input", a->input,
          "CT: a folder with one DICOM series, or a .nii, .nii.gz, .nrrd, .mha or .dcm file; with "
          "--labels also a case, of which a corrected version is made")
      ->required();
  command->add_option("--out", a->out, "Folder for the case")->required();
  command->add_option("--truth", a->truth,
                      "Label volume to compare with; its numbers in labels.json beside it");
  command->add_option("--truth-surfaces", a->true_surfaces,
                      "Folder with a surface of each bone to compare with (radius.ply, ...), in "
                      "the scan's frame (LPS) in mm");
  command->add_option("--labels", a->labels,
                      "Bones as outlined elsewhere, instead of segmenting: a label volume or a "
                      "DICOM segmentation (.dcm) on the scan's grid");
  command->add_option("--names", a->names,
                      "Which number of --labels is which bone: a JSON file, {\"radius\": 1, ...}");
  command->add_option("--json", a->json, "Write every figure to this file");
  command->add_option("--series", a->series, "SeriesInstanceUID, where a folder holds several");
  command->add_option("--list-series", a->list_series,
                      "Where a folder holds several and none is chosen, write which to this file");
  command->add_option("--pseudonym", a->pseudonym, "What the case is called; never a person's name")
      ->check([](const std::string& name) {
        constexpr std::size_t kLongest = 128;  // as case.json and the page take it
        const bool is_plain = std::none_of(
            name.begin(), name.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20; });
        return name.size() <= kLongest && is_plain
                   ? std::string()
                   : std::string("use at most 128 bytes, without control characters");
      });
  command->add_flag("--simulated", a->simulated, "Mark the case as simulated, not scanned");
  command->add_flag("--force", a->force, "Replace an existing case");
  command->callback([a, command] {
    a->has_pseudonym = command->count("--pseudonym") > 0;
    run(*a);
  });
}

}  // namespace carpus::cli
