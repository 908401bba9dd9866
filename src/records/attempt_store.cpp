// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "records/attempt_store.hpp"

#include <SQLiteCpp/SQLiteCpp.h>
#include <sqlite3.h>

#include <cstring>
#include <string>
#include <utility>

#include "core/error.hpp"
#include "records/detail/asset_form_table.hpp"
#include "records/detail/quiz_answer_table.hpp"
#include "records/detail/schema.hpp"

namespace carpus::records {

static_assert(detail::kMigrations.size() == kRecordsSchemaVersion);

namespace {

/// What the list shows of an attempt.
constexpr const char* kSummaryColumns =
    "id, origin, trainee, case_name, case_fingerprint, case_simulated, procedure, mode, "
    "input_device, started_at, ended_at, outcome, overall, duration_ticks, final_hash";

/// What its finished ASSET forms say together.
constexpr const char* kAssetColumns =
    ", (SELECT count(f.total) FROM asset_form AS f WHERE f.attempt = attempt.id) AS asset_forms, "
    "(SELECT sum(f.passes) FROM asset_form AS f WHERE f.attempt = attempt.id) AS asset_passed, "
    "(SELECT avg(f.total) FROM asset_form AS f WHERE f.attempt = attempt.id) AS asset_mean";

/// Says in words what to do about an SQLite error.
std::string advice(const SQLite::Exception& error) {
  switch (error.getErrorCode()) {
    case SQLITE_FULL:
      return "free some space and try again";
    case SQLITE_READONLY:
      return "the file is read-only; make it writable or choose another with --records";
    case SQLITE_CANTOPEN:
      return "the file cannot be opened or created; check that its folder exists and is writable, "
             "or choose another with --records";
    case SQLITE_BUSY:
    case SQLITE_LOCKED:
      return "another program is using the file; close it and try again";
    case SQLITE_NOTADB:
      return "this is not a records file; choose another with --records";
    case SQLITE_CORRUPT:
      return "the file is damaged; 'carpus attempts --repair' saves what can be read of it; or "
             "restore it from a copy, or choose another with --records";
    case SQLITE_IOERR:
      return "the disk refused to read or write; it may be full or failing: free some space and "
             "try again";
    default:
      return "choose another file with --records";
  }
}

[[noreturn]] void fail(const std::filesystem::path& file,
                       const std::string& what,
                       const SQLite::Exception& error) {
  const std::string message =
      "records " + file.string() + ": " + what + ": " + error.what() + "; " + advice(error);
  const int code = error.getErrorCode();
  if (code == SQLITE_BUSY || code == SQLITE_LOCKED) throw RecordsBusy(message);
  throw IoError(message);
}

/// The first thing that is wrong with a file, or empty; what cannot be told within the time is
/// taken for sound.
std::string damage_of(SQLite::Database& database, std::chrono::milliseconds time) {
  using std::chrono::steady_clock;
  auto deadline = steady_clock::now() + time;
  constexpr int kStepsBetweenLooks = 1000;
  ::sqlite3_progress_handler(
      database.getHandle(), kStepsBetweenLooks,
      [](void* end) {
        return static_cast<int>(steady_clock::now() > *static_cast<steady_clock::time_point*>(end));
      },
      &deadline);
  std::string answer = "ok";
  try {
    answer = database.execAndGet("PRAGMA quick_check(1)").getString();
  } catch (const SQLite::Exception& error) {
    if (error.getErrorCode() != SQLITE_INTERRUPT) answer = error.what();
  }
  ::sqlite3_progress_handler(database.getHandle(), 0, nullptr, nullptr);
  return answer == "ok" ? "" : answer;
}

AttemptSummary read_summary(SQLite::Statement& row) {
  AttemptSummary summary;
  summary.id = row.getColumn("id").getInt64();
  summary.origin = row.getColumn("origin").getString();
  summary.trainee = row.getColumn("trainee").getString();
  summary.case_name = row.getColumn("case_name").getString();
  summary.case_fingerprint = row.getColumn("case_fingerprint").getString();
  const SQLite::Column simulated = row.getColumn("case_simulated");
  if (!simulated.isNull()) summary.case_simulated = simulated.getInt() != 0;
  summary.procedure = row.getColumn("procedure").getString();
  const SQLite::Column mode = row.getColumn("mode");
  if (!mode.isNull()) summary.mode = mode.getString();
  summary.input_device = row.getColumn("input_device").getString();
  summary.started_at = row.getColumn("started_at").getString();
  summary.ended_at = row.getColumn("ended_at").getString();
  summary.outcome =
      row.getColumn("outcome").getString() == "finished" ? Outcome::Finished : Outcome::Unfinished;
  const SQLite::Column overall = row.getColumn("overall");
  if (!overall.isNull()) summary.overall = overall.getDouble();
  summary.duration_ticks = static_cast<std::uint64_t>(row.getColumn("duration_ticks").getInt64());
  summary.final_hash = row.getColumn("final_hash").getString();
  if (const std::int64_t forms = row.getColumn("asset_forms").getInt64(); forms > 0) {
    summary.asset = AssetSummary{forms, row.getColumn("asset_passed").getInt64(),
                                 row.getColumn("asset_mean").getDouble()};
  }
  return summary;
}

void bind(SQLite::Statement& insert, const Attempt& attempt) {
  const AttemptSummary& summary = attempt.summary;
  if (!summary.origin.empty()) insert.bind(":origin", summary.origin);
  insert.bind(":trainee", summary.trainee);
  insert.bind(":case_name", summary.case_name);
  insert.bind(":case_fingerprint", summary.case_fingerprint);
  if (summary.case_simulated) insert.bind(":case_simulated", *summary.case_simulated ? 1 : 0);
  insert.bind(":procedure", summary.procedure);
  if (!summary.mode.empty()) insert.bind(":mode", summary.mode);
  insert.bind(":input_device", summary.input_device);
  insert.bind(":started_at", summary.started_at);
  insert.bind(":ended_at", summary.ended_at);
  insert.bind(":outcome", std::string(name_of(summary.outcome)));
  if (summary.overall) insert.bind(":overall", *summary.overall);
  insert.bind(":duration_ticks", static_cast<std::int64_t>(summary.duration_ticks));
  insert.bind(":final_hash", summary.final_hash);
  insert.bind(":score", attempt.score_json);
  insert.bind(":events", attempt.events_json);
  // SQLite stores NULL for a null pointer, which an empty vector may give.
  insert.bind(":recording",
              attempt.recording.empty() ? "" : static_cast<const void*>(attempt.recording.data()),
              static_cast<int>(attempt.recording.size()));
}

}  // namespace

std::string_view name_of(Outcome outcome) noexcept {
  return outcome == Outcome::Finished ? "finished" : "unfinished";
}

struct AttemptStore::Connection {
  SQLite::Database database;

  Connection(const std::filesystem::path& file, std::chrono::milliseconds patience)
      : database(file.string(),
                 SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE,
                 static_cast<int>(patience.count())) {}

  int pragma(const char* name) {
    return database.execAndGet(std::string("PRAGMA ") + name).getInt();
  }

  void prepare(const std::filesystem::path& file) {
    const int version = pragma("user_version");
    const bool is_new =
        version == 0 && database.execAndGet("SELECT count(*) FROM sqlite_master").getInt() == 0;
    if (!is_new && pragma("application_id") != detail::kApplicationId) {
      throw IoError("records " + file.string() +
                    ": a database of another program; choose another file with --records");
    }
    if (version > kRecordsSchemaVersion) {
      throw SchemaError("records " + file.string() + ": schema version " + std::to_string(version) +
                        " is newer than " + std::to_string(kRecordsSchemaVersion) +
                        ", which this program knows; update Carpus or choose another file with "
                        "--records");
    }
    database.exec("PRAGMA journal_mode = WAL");
    database.exec("PRAGMA synchronous = FULL");
    if (version < kRecordsSchemaVersion) migrate();
    if (const std::string damage = damage_of(database, kCheckTime); !damage.empty()) {
      throw SQLite::Exception(damage, SQLITE_CORRUPT);
    }
    prove_writable();
  }

  /// A file that nothing can be stored in is known before an operation, not after it.
  void prove_writable() {
    try {
      database.exec("BEGIN IMMEDIATE");
      database.exec("ROLLBACK");
    } catch (const SQLite::Exception& error) {
      if (error.getErrorCode() != SQLITE_BUSY) throw;  // who writes now shows that it can be
    }
  }

  void migrate() {
    SQLite::Transaction transaction(database, SQLite::TransactionBehavior::IMMEDIATE);
    // Another process may have done it while this one waited for the lock.
    for (int version = pragma("user_version"); version < kRecordsSchemaVersion; ++version) {
      database.exec(detail::kMigrations[static_cast<std::size_t>(version)]);
    }
    database.exec("PRAGMA application_id = " + std::to_string(detail::kApplicationId));
    database.exec("PRAGMA user_version = " + std::to_string(kRecordsSchemaVersion));
    transaction.commit();
  }
};

AttemptStore::AttemptStore(const std::filesystem::path& file, std::chrono::milliseconds patience)
    : file_(file) {
  try {
    connection_ = std::make_unique<Connection>(file, patience);
    connection_->prepare(file);
  } catch (const SQLite::Exception& error) {
    fail(file, "cannot open", error);
  }
}

AttemptStore::~AttemptStore() = default;
AttemptStore::AttemptStore(AttemptStore&&) noexcept = default;
AttemptStore& AttemptStore::operator=(AttemptStore&&) noexcept = default;

std::int64_t AttemptStore::save(const Attempt& attempt) {
  try {
    SQLite::Transaction transaction(connection_->database, SQLite::TransactionBehavior::IMMEDIATE);
    if (const auto known = id_of(attempt.summary.origin)) return *known;
    SQLite::Statement insert(
        connection_->database,
        "INSERT INTO attempt (origin, trainee, case_name, case_fingerprint, case_simulated, "
        "procedure, "
        "mode, input_device, started_at, ended_at, outcome, overall, duration_ticks, final_hash, "
        "score, "
        "events, recording) VALUES (:origin, :trainee, :case_name, :case_fingerprint, "
        ":case_simulated, "
        ":procedure, :mode, :input_device, :started_at, :ended_at, :outcome, :overall, "
        ":duration_ticks, "
        ":final_hash, :score, :events, :recording)");
    bind(insert, attempt);
    insert.exec();
    const std::int64_t id = connection_->database.getLastInsertRowid();
    transaction.commit();
    return id;
  } catch (const SQLite::Exception& error) {
    fail(file_, "the attempt was not stored", error);
  }
}

std::int64_t AttemptStore::save(const QuizAnswer& answer) {
  try {
    return detail::insert(connection_->database, answer);
  } catch (const SQLite::Exception& error) {
    fail(file_, "the answer was not stored", error);
  }
}

AssetSaving AttemptStore::save(const AssetForm& form, std::int64_t amended) {
  try {
    SQLite::Transaction transaction(connection_->database, SQLite::TransactionBehavior::IMMEDIATE);
    const AssetSaving saving = detail::save(connection_->database, form, amended);
    if (saving == AssetSaving::Saved) transaction.commit();
    return saving;
  } catch (const SQLite::Exception& error) {
    fail(file_, "the form was not stored", error);
  }
}

std::vector<AssetForm> AttemptStore::asset_forms(std::int64_t attempt) const {
  try {
    return detail::read_forms(connection_->database, attempt);
  } catch (const SQLite::Exception& error) {
    fail(file_, "cannot read how attempt " + std::to_string(attempt) + " was rated", error);
  }
}

QuizAnswerPage AttemptStore::quiz_page(std::int64_t before,
                                       std::size_t most,
                                       const AttemptFilter& seen) const {
  try {
    return detail::read_page(connection_->database, before, most, seen);
  } catch (const SQLite::Exception& error) {
    fail(file_, "cannot read the answers of the view quiz", error);
  }
}

std::vector<AttemptSummary> AttemptStore::list() const {
  try {
    std::vector<AttemptSummary> attempts;
    SQLite::Statement rows(connection_->database, std::string("SELECT ") + kSummaryColumns +
                                                      kAssetColumns +
                                                      " FROM attempt ORDER BY id DESC");
    while (rows.executeStep()) attempts.push_back(read_summary(rows));
    return attempts;
  } catch (const SQLite::Exception& error) {
    fail(file_, "cannot read the attempts", error);
  }
}

AttemptPage AttemptStore::page(std::int64_t before,
                               std::size_t most,
                               const AttemptFilter& seen) const {
  try {
    // All questions see the same state.
    SQLite::Transaction transaction(connection_->database);
    AttemptPage page;
    SQLite::Statement ids(connection_->database, "SELECT id FROM attempt ORDER BY id DESC");
    SQLite::Statement row(connection_->database, std::string("SELECT ") + kSummaryColumns +
                                                     kAssetColumns + " FROM attempt WHERE id = ?");
    while (ids.executeStep()) {
      const std::int64_t id = ids.getColumn(0).getInt64();
      if (seen && !seen(id)) continue;
      ++page.total;
      if (before > 0 && id >= before) continue;
      page.older = page.attempts.size() == most;
      if (page.older) continue;
      row.reset();
      row.bind(1, id);
      if (row.executeStep()) page.attempts.push_back(read_summary(row));
    }
    return page;
  } catch (const SQLite::Exception& error) {
    fail(file_, "cannot read the attempts", error);
  }
}

std::optional<std::int64_t> AttemptStore::id_of(const std::string& origin) const {
  if (origin.empty()) return std::nullopt;
  SQLite::Statement row(connection_->database, "SELECT id FROM attempt WHERE origin = ?");
  row.bind(1, origin);
  if (!row.executeStep()) return std::nullopt;
  return row.getColumn(0).getInt64();
}

bool AttemptStore::holds(const std::string& origin) const {
  try {
    return id_of(origin).has_value();
  } catch (const SQLite::Exception& error) {
    fail(file_, "cannot read the attempts", error);
  }
}

std::optional<Attempt> AttemptStore::find(std::int64_t id) const {
  try {
    SQLite::Statement row(connection_->database,
                          std::string("SELECT *") + kAssetColumns + " FROM attempt WHERE id = ?");
    row.bind(1, id);
    if (!row.executeStep()) return std::nullopt;
    Attempt attempt;
    attempt.summary = read_summary(row);
    attempt.score_json = row.getColumn("score").getString();
    attempt.events_json = row.getColumn("events").getString();
    const SQLite::Column blob = row.getColumn("recording");
    attempt.recording.resize(static_cast<std::size_t>(blob.getBytes()));
    if (!attempt.recording.empty()) {
      std::memcpy(attempt.recording.data(), blob.getBlob(), attempt.recording.size());
    }
    return attempt;
  } catch (const SQLite::Exception& error) {
    fail(file_, "cannot read attempt " + std::to_string(id), error);
  }
}

void AttemptStore::limit_pages(int pages) {
  connection_->database.exec("PRAGMA max_page_count = " + std::to_string(pages));
}

}  // namespace carpus::records
