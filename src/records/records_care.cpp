// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "records/records_care.hpp"

#include <SQLiteCpp/Backup.h>
#include <SQLiteCpp/SQLiteCpp.h>
#include <sqlite3.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "core/error.hpp"
#include "records/atomic_file.hpp"
#include "records/attempt_store.hpp"
#include "records/detail/file_descriptor.hpp"
#include "records/journals_left_behind.hpp"
#include "records/rescue_file.hpp"
#include "records/utc_time.hpp"

namespace carpus::records {

namespace {

namespace fs = std::filesystem;

constexpr int kPatienceMs = 2000;
/// Problems that are worth a line each.
constexpr int kMostProblems = 20;

SQLite::Database open(const fs::path& file, int how) {
  try {
    return SQLite::Database(file.string(), how, kPatienceMs);
  } catch (const SQLite::Exception& error) {
    throw IoError("records " + file.string() + ": cannot open: " + error.what());
  }
}

/// The highest number that was ever given in a table; 0 where not even that can be read.
std::int64_t highest_id(SQLite::Database& database, const std::string& table) {
  std::int64_t highest = 0;
  for (const std::string& question :
       {"SELECT seq FROM sqlite_sequence WHERE name = '" + table + "'",
        "SELECT id FROM " + table + " ORDER BY id DESC LIMIT 1"}) {
    try {
      highest = std::max(highest, database.execAndGet(question).getInt64());
    } catch (const SQLite::Exception&) {
      continue;  // the other may answer
    }
  }
  return highest;
}

/// Copies rows from one file into another, whatever columns of today's the older has.
class RowCopier {
 public:
  RowCopier(SQLite::Database& from, SQLite::Database& to, const std::string& table)
      : row_(from, "SELECT * FROM " + table + " WHERE id = ?"),
        insert_(to, insertion(row_, table)) {}

  /// Nothing where there is no such row, false where it cannot be read.
  std::optional<bool> copy(std::int64_t id) {
    try {
      row_.reset();
      row_.bind(1, id);
      if (!row_.executeStep()) return std::nullopt;
    } catch (const SQLite::Exception&) {
      return false;
    }
    insert_.tryReset();  // the row before may have been refused
    for (int i = 0; i < row_.getColumnCount(); ++i) bind(i);
    insert_.exec();
    return true;
  }

 private:
  static std::string insertion(const SQLite::Statement& row, const std::string& table) {
    std::string names;
    std::string values;
    for (int i = 0; i < row.getColumnCount(); ++i) {
      names += (i == 0 ? "" : ", ") + std::string(row.getColumnName(i));
      values += i == 0 ? "?" : ", ?";
    }
    return "INSERT INTO " + table + " (" + names + ") VALUES (" + values + ")";
  }

  void bind(int i) {
    const SQLite::Column value = row_.getColumn(i);
    if (value.isInteger()) {
      insert_.bind(i + 1, value.getInt64());
    } else if (value.isFloat()) {
      insert_.bind(i + 1, value.getDouble());
    } else if (value.isText()) {
      insert_.bind(i + 1, value.getString());
    } else if (value.isBlob()) {
      insert_.bind(i + 1, value.getBytes() == 0 ? "" : value.getBlob(), value.getBytes());
    } else {
      insert_.bind(i + 1);
    }
  }

  SQLite::Statement row_;
  SQLite::Statement insert_;
};

/// Of a table that belongs to no attempt's own row, where the file has it at all: it may be older.
/// None is named where it is lost; the attempts are what a repair is for.
void copy_rows(SQLite::Database& from, SQLite::Database& to, const std::string& table) {
  try {
    RowCopier rows(from, to, table);
    const std::int64_t highest = highest_id(from, table);
    for (std::int64_t id = 1; id <= highest; ++id) {
      try {
        (void)rows.copy(id);
      } catch (const SQLite::Exception&) {
        continue;  // one row that today's schema refuses
      }
    }
  } catch (const SQLite::Exception&) {
    return;
  }
}

void remove_whole(const fs::path& file) {
  std::error_code ignored;
  for (const char* suffix : {"", "-wal", "-shm", "-journal"}) {
    fs::remove(file.string() + suffix, ignored);
  }
}

/// The damaged file is read; what cannot be is counted.
RecordsRepair save_what_can_be_read(const fs::path& file, const fs::path& saved) {
  RecordsRepair repair;
  { const AttemptStore empty(saved); }  // with today's schema
  SQLite::Database database = open(file, SQLite::OPEN_READWRITE);
  SQLite::Database copy = open(saved, SQLite::OPEN_READWRITE);
  // Nobody else writes meanwhile: a station's attempts must not be left behind.
  database.exec("BEGIN EXCLUSIVE");
  copy.exec("BEGIN");
  const std::int64_t highest = highest_id(database, "attempt");
  RowCopier rows(database, copy, "attempt");
  for (std::int64_t id = 1; id <= highest; ++id) {
    const auto copied = rows.copy(id);
    if (copied && *copied) ++repair.saved;
    if (copied && !*copied) repair.lost.push_back(id);
  }
  if (repair.saved == 0 && highest == 0) {
    throw IoError("records " + file.string() +
                  ": nothing of it can be read; restore it from a copy");
  }
  copy_rows(database, copy, "quiz_answer");
  copy_rows(database, copy, "asset_form");
  // A form whose attempt is lost would come to belong to the next one of that number.
  copy.exec("DELETE FROM asset_form WHERE attempt NOT IN (SELECT id FROM attempt)");
  copy.exec("COMMIT");
  // A file by itself: it is about to get another name.
  copy.exec("PRAGMA journal_mode = DELETE");
  return repair;
}

}  // namespace

RecordsCheck check_records(const fs::path& file) {
  RecordsCheck check;
  SQLite::Database database = open(file, SQLite::OPEN_READONLY);
  try {
    SQLite::Statement rows(database,
                           "PRAGMA integrity_check(" + std::to_string(kMostProblems) + ")");
    while (rows.executeStep()) {
      const std::string line = rows.getColumn(0).getString();
      if (line != "ok") check.problems.push_back(line);
    }
    SQLite::Statement attempts(database, "SELECT id, recording FROM attempt");
    while (attempts.executeStep()) ++check.attempts;
  } catch (const SQLite::Exception& error) {
    check.problems.emplace_back(error.what());
  }
  for (const fs::path& each : rescue_files(file)) {
    check.waiting.push_back(each.string() + ": a rescued attempt; the next station takes it back");
  }
  for (const fs::path& each : files_beside(file, ".running-", ".journal")) {
    check.waiting.push_back(each.string() + ": an attempt that runs or was left running");
  }
  return check;
}

RecordsRepair repair_records(const fs::path& file) {
  const std::string stamp = utc_now();
  std::string suffix;
  for (const char c : stamp) {
    if (c != '-' && c != ':' && c != '.') suffix += c;
  }
  const fs::path saved = file.string() + ".repaired-" + suffix;
  RecordsRepair repair;
  try {
    repair = save_what_can_be_read(file, saved);
    repair.damaged = file;
    repair.damaged.replace_filename(file.stem().string() + ".damaged-" + suffix + ".sqlite");
    fs::copy_file(file, repair.damaged);
    for (const char* part : {"-wal", "-shm"}) {
      if (!fs::exists(file.string() + part)) continue;
      fs::copy_file(file.string() + part, repair.damaged.string() + part);
      // It must not be taken for the new file's.
      fs::remove(file.string() + part);
    }
    fs::rename(saved, file);
    (void)detail::flush_folder_of(file);
  } catch (const SQLite::Exception& error) {
    remove_whole(saved);
    const bool busy = error.getErrorCode() == SQLITE_BUSY;
    throw IoError("records " + file.string() + ": not repaired: " + error.what() +
                  (busy ? "; stop the station that uses it first" : ""));
  } catch (const fs::filesystem_error& error) {
    remove_whole(saved);
    throw IoError("records " + file.string() + ": not repaired: " + error.what());
  } catch (const Error&) {
    remove_whole(saved);
    throw;
  }
  return repair;
}

std::int64_t back_up_records(const fs::path& file, const fs::path& target) {
  std::int64_t attempts = 0;
  SQLite::Database source = open(file, SQLite::OPEN_READONLY);
  write_file_atomically(target, [&](const fs::path& temporary) {
    try {
      SQLite::Database copy(temporary.string(), SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE);
      // In one go: a part at a time would begin anew with every attempt that a station stores.
      SQLite::Backup(copy, source).executeStep(-1);
      // A file by itself, without what a reader would leave beside it.
      copy.exec("PRAGMA journal_mode = DELETE");
      attempts = copy.execAndGet("SELECT count(*) FROM attempt").getInt64();
    } catch (const SQLite::Exception& error) {
      throw IoError("records " + file.string() + ": no copy was made: " + error.what());
    }
  });
  return attempts;
}

}  // namespace carpus::records
