// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "server/new_case_desk.hpp"

#include <fcntl.h>
#include <sys/random.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <nlohmann/json.hpp>
#include <utility>

#include "core/error.hpp"
#include "core/hexadecimal.hpp"
#include "core/person_name.hpp"
#include "core/text_format.hpp"
#include "server/query_number.hpp"
#include "server/query_text.hpp"
#include "server/request_head.hpp"

namespace carpus::server {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
using Clock = std::chrono::steady_clock;

constexpr std::size_t kLongestTitle = 100;
constexpr std::size_t kLongestId = 64;
/// What a file may be; anything else is not stored.
constexpr std::array<std::string_view, 5> kKinds{"dcm", "nii", "nii.gz", "nrrd", "mha"};

/// What a look makes.
struct MadeFile {
  std::string_view name;
  const char* media_type;
};
constexpr std::array<MadeFile, 3> kMadeFiles{MadeFile{"bones.glb", "model/gltf-binary"},
                                             MadeFile{"labels.nii.gz", "application/gzip"},
                                             MadeFile{"mended.json", "application/json"}};
constexpr std::uintmax_t kLargestMadeFile = std::uintmax_t{256} << 20U;

std::string new_word() {
  std::array<std::uint64_t, 2> bytes{};
  if (::getrandom(bytes.data(), sizeof bytes, 0) != static_cast<ssize_t>(sizeof bytes)) {
    throw IoError("the system gives no random numbers");
  }
  return hexadecimal(bytes[0]) + hexadecimal(bytes[1]);
}

std::string_view path_of(const HttpRequest& request) {
  const std::string_view target = request.target;
  return target.substr(0, target.find('?'));
}

HttpResponse nothing_of_yours() {
  return make_problem(409, "That has been given up, or another page is adding a case; begin anew.");
}

}  // namespace

/// Writes one file; nothing half-written stays.
class NewCaseDesk::FileTaker final : public BodyTaker {
 public:
  FileTaker(NewCaseDesk& desk, std::string word, fs::path folder, std::string name)
      : desk_(desk), word_(std::move(word)), folder_(std::move(folder)), name_(std::move(name)) {}
  ~FileTaker() override {
    if (descriptor_ >= 0) ::close(descriptor_);
    if (!is_whole_) desk_.lose(word_, folder_);
  }
  FileTaker(const FileTaker&) = delete;
  FileTaker& operator=(const FileTaker&) = delete;

  HttpResponse take(std::string_view piece) override {
    {
      const std::lock_guard lock(desk_.mutex_);
      if (desk_.word_ != word_ || desk_.stage_ != Stage::Receiving) return nothing_of_yours();
      desk_.heard_ = Clock::now();
    }
    if (descriptor_ < 0) {
      std::error_code error;
      if (fs::space(folder_, error).available < desk_.options_.least_free_bytes || error) {
        return make_problem(507, "The station's disk is almost full; nothing was stored.");
      }
      descriptor_ = ::open((folder_ / name_).c_str(),
                           O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0600);
      if (descriptor_ < 0) return make_problem(507, "The station cannot store the file.");
    }
    while (!piece.empty()) {
      const ssize_t written = ::write(descriptor_, piece.data(), piece.size());
      if (written <= 0) {
        return make_problem(507, "The station's disk took only part of the file; it is full.");
      }
      piece.remove_prefix(static_cast<std::size_t>(written));
    }
    return make_response(kGoOn, "", "");
  }

  HttpResponse finish() override {
    const std::lock_guard lock(desk_.mutex_);
    if (desk_.word_ != word_ || desk_.stage_ != Stage::Receiving) return nothing_of_yours();
    desk_.files_.push_back(name_);
    desk_.has_taker_ = false;
    desk_.heard_ = Clock::now();
    is_whole_ = true;
    return make_json(Json{{"files", desk_.files_.size()}}.dump());
  }

 private:
  NewCaseDesk& desk_;
  std::string word_;
  fs::path folder_;
  std::string name_;
  int descriptor_ = -1;
  bool is_whole_ = false;
};

NewCaseDesk::NewCaseDesk(NewCaseOptions options) : options_(std::move(options)) {
  std::error_code error;
  // What a station left behind that was killed.
  fs::remove_all(options_.incoming, error);
  if (!error) fs::create_directories(options_.incoming, error);
  if (!error) {
    fs::permissions(options_.incoming, fs::perms::owner_all, fs::perm_options::replace, error);
  }
  if (error) {
    throw IoError(options_.incoming.string() +
                  ": the folder for new scans cannot be made: " + error.message());
  }
}

NewCaseDesk::~NewCaseDesk() {
  const std::lock_guard lock(mutex_);
  give_up();  // what is being made is thrown away when it has ended
}

bool NewCaseDesk::is_for(const HttpRequest& request) {
  const std::string_view path = path_of(request);
  return path == kNewCasePath ||
         (path.starts_with(kNewCasePath) && path[kNewCasePath.size()] == '/');
}

HttpResponse NewCaseDesk::answer(const HttpRequest& request) {
  if (request.method == "GET" && request.target == kNewCasePath) {
    return make_json(Json{{"may_add", request.guest.role == Role::Instructor}}.dump());
  }
  if (request.guest.role != Role::Instructor) {
    return make_problem(403, "Only who came by an instructor's link may add cases.");
  }
  const std::string_view path = path_of(request);
  const std::lock_guard lock(mutex_);
  if (request.method == "POST" && path == kNewCasePath) return begin();
  if (!is_current(request)) return nothing_of_yours();
  heard_ = Clock::now();
  if (request.method == "POST" && path == kNewCaseRunPath) return run(request);
  if (request.method == "DELETE" && path == kNewCasePath) {
    give_up();
    return make_json("{}");
  }
  if (request.method == "GET" && path == kNewCasePath) return tell();
  if (request.method == "GET" && path == kNewCaseMadePath) return give_out(request);
  return make_problem(404, "There is no such thing here.");
}

bool NewCaseDesk::is_current(const HttpRequest& request) const {
  const auto word = text_in_query(request.target, "word");
  return stage_ != Stage::Idle && word && *word == word_;
}

HttpResponse NewCaseDesk::begin() {
  if (options_.truth->is_closed()) {
    return make_problem(409,
                        "An assessed operation is under way here; add cases when it has ended.");
  }
  if (stage_ == Stage::Receiving || stage_ == Stage::Working || stage_ == Stage::Choosing) {
    return make_problem(409, "Another page is adding a case just now; try again in a minute.");
  }
  throw_away();
  word_ = new_word();
  folder_ = options_.incoming / word_;
  std::error_code error;
  if (!fs::create_directory(folder_, error) || error) {
    return make_problem(507, "The station cannot store anything: " + error.message() + ".");
  }
  stage_ = Stage::Receiving;
  heard_ = Clock::now();
  return make_json(Json{{"word", word_}}.dump());
}

std::variant<std::unique_ptr<BodyTaker>, HttpResponse> NewCaseDesk::take_body(
    const HttpRequest& request,
    std::uint64_t bytes) {
  const auto kind = text_in_query(request.target, "as");
  if (!kind || std::find(kKinds.begin(), kKinds.end(), *kind) == kKinds.end()) {
    return make_problem(415, "Files of this kind are not taken.");
  }
  const std::lock_guard lock(mutex_);
  if (!is_current(request) || stage_ != Stage::Receiving) return nothing_of_yours();
  if (has_taker_) return make_problem(409, "One file after the other, please.");
  if (files_.size() >= options_.most_files) {
    return make_problem(413, format("More than %zu files are not taken.", options_.most_files));
  }
  if (bytes > options_.most_bytes - bytes_) {
    return make_problem(413, format("More than %.0f MB are not taken at once.",
                                    static_cast<double>(options_.most_bytes) / 1e6));
  }
  bytes_ += bytes;
  has_taker_ = true;
  heard_ = Clock::now();
  return std::make_unique<FileTaker>(*this, word_, folder_,
                                     format("%05zu.%s", files_.size() + 1, kind->c_str()));
}

HttpResponse NewCaseDesk::run(const HttpRequest& request) {
  if (stage_ == Stage::Choosing) return run_chosen(request);
  if (stage_ != Stage::Receiving || has_taker_) return make_problem(409, "Not all files are here.");
  const auto title = text_in_query(request.target, "title");
  const auto of_case = text_in_query(request.target, "of");
  if (!title || title->size() > kLongestTitle || (!title->empty() && problem_of_name(*title))) {
    return make_problem(400, format("The title is at most %zu plain characters.", kLongestTitle));
  }
  if (!of_case || of_case->size() > kLongestId) {
    return make_problem(400, "It does not say of which case.");
  }
  if (files_.empty()) return make_problem(400, "There is no file to make it of.");
  const bool is_look = text_in_query(request.target, "look") == "1";
  const bool are_labels = std::all_of(files_.begin(), files_.end(), [](const std::string& file) {
    return file.ends_with(".nii.gz");
  });
  if (is_look && (of_case->empty() || files_.size() > 2 || !are_labels)) {
    return make_problem(400, "To look at come labels of a case, nii.gz, and those before.");
  }
  if (!is_look && !of_case->empty() && (files_.size() != 1 || !are_labels)) {
    return make_problem(400, "Labels come as one file, nii.gz.");
  }
  NewCaseTask task;
  if (is_look) {
    task.purpose = text_in_query(request.target, "grow") == "1" ? NewCasePurpose::GrownLook
                                                                : NewCasePurpose::Look;
  }
  task.folder = folder_;
  task.files = files_;
  task.title = *title;
  task.of_case = *of_case;
  return start(task);
}

HttpResponse NewCaseDesk::run_chosen(const HttpRequest& request) {
  const auto series = number_in_query(request.target, "series");
  const auto text = text_in_query(request.target, "series");
  if (!series || !text || text->empty() ||
      std::cmp_greater_equal(*series, outcome_.series.size())) {
    return make_problem(400, "It does not say which series.");
  }
  NewCaseTask task = task_;
  task.series_uid = outcome_.series[static_cast<std::size_t>(*series)].uid;
  return start(task);
}

HttpResponse NewCaseDesk::start(const NewCaseTask& task) {
  if (options_.truth->is_closed()) {
    return make_problem(409, "An assessed operation is under way here; try when it has ended.");
  }
  task_ = task;
  stop_ = false;
  doing_ = "waiting";
  fraction_ = 0;
  if (!worker_.post([this, task] { work(task); })) {
    return make_problem(503, "What was given up before is still being ended; try again.");
  }
  stage_ = Stage::Working;
  return tell();
}

void NewCaseDesk::work(const NewCaseTask& task) {
  const auto progress = [this](std::string_view doing, double fraction) {
    const std::lock_guard lock(mutex_);
    doing_ = doing;
    fraction_ = fraction;
  };
  NewCaseOutcome outcome;
  try {
    outcome = options_.make(task, progress, stop_);
  } catch (const std::exception& error) {
    outcome.problem = error.what();
  }
  const std::lock_guard lock(mutex_);
  heard_ = Clock::now();
  if (stop_) return throw_away();
  outcome_ = std::move(outcome);
  if (!outcome_.series.empty()) {
    stage_ = Stage::Choosing;
    return;
  }
  stage_ = Stage::Done;
  if (!outcome_.made.empty()) return;  // its page fetches it, and gives it up
  // What was brought is a patient's: it stays no longer than needed.
  remove_later(folder_);
}

HttpResponse NewCaseDesk::tell() const {
  Json json;
  constexpr std::array<const char*, 5> kNames{"idle", "receiving", "working", "choosing", "done"};
  const bool is_stopping = stage_ == Stage::Working && stop_;
  json["state"] = is_stopping ? "stopping" : kNames.at(static_cast<std::size_t>(stage_));
  json["files"] = files_.size();
  json["doing"] = doing_;
  json["fraction"] = fraction_;
  json["id"] = outcome_.id;
  json["problem"] = outcome_.problem;
  json["series"] = Json::array();
  for (const SeriesOffer& one : outcome_.series) {
    json["series"].push_back(
        {{"description", one.description}, {"slices", one.slices}, {"spacing_mm", one.spacing_mm}});
  }
  // What a program said is not promised to be text.
  return make_json(json.dump(-1, ' ', false, Json::error_handler_t::replace));
}

HttpResponse NewCaseDesk::give_out(const HttpRequest& request) const {
  const auto wanted = text_in_query(request.target, "file");
  const auto* file = std::find_if(kMadeFiles.begin(), kMadeFiles.end(),
                                  [&](const MadeFile& each) { return wanted == each.name; });
  const bool is_there = stage_ == Stage::Done && !outcome_.made.empty();
  if (!is_there || file == kMadeFiles.end()) return make_problem(404, "No such thing was made.");
  if (options_.truth->is_closed()) {
    return make_problem(409, "An assessed operation is under way here; look when it has ended.");
  }
  const fs::path path = outcome_.made / file->name;
  std::error_code error;
  const auto size = fs::file_size(path, error);
  if (error || size > kLargestMadeFile) return make_problem(404, "No such thing was made.");
  std::string bytes(size, '\0');
  std::ifstream stream(path, std::ios::binary);
  stream.read(bytes.data(), static_cast<std::streamsize>(size));
  if (!stream) return make_problem(404, "What was made cannot be read.");
  return make_response(200, file->media_type, std::move(bytes));
}

void NewCaseDesk::tend() {
  const std::lock_guard lock(mutex_);
  const bool is_forgotten = Clock::now() - heard_ > options_.lapse;
  // What is being made was wanted: it goes on, and stands in the list when it is there.
  if (is_forgotten && stage_ != Stage::Working) throw_away();
}

void NewCaseDesk::give_up() {
  stop_ = true;
  if (stage_ != Stage::Working) throw_away();
}

void NewCaseDesk::throw_away() {
  if (stage_ == Stage::Idle) return;
  stage_ = Stage::Idle;
  word_.clear();
  files_.clear();
  bytes_ = 0;
  has_taker_ = false;
  doing_.clear();
  fraction_ = 0;
  task_ = {};
  outcome_ = {};
  remove_later(std::exchange(folder_, {}));
}

void NewCaseDesk::lose(const std::string& word, const fs::path& folder) {
  const std::lock_guard lock(mutex_);
  if (word_ == word && stage_ == Stage::Receiving) throw_away();
  // Whoever gave it up meanwhile may have removed it before the file was there.
  remove_later(folder);
}

void NewCaseDesk::remove_later(const fs::path& folder) {
  if (folder.empty() || folder.parent_path() != options_.incoming) return;
  const bool is_posted = chores_.post([folder] {
    std::error_code ignored;  // the next start tries again
    fs::remove_all(folder, ignored);
  });
  (void)is_posted;
}

}  // namespace carpus::server
