#include "studies/engine/store.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sqlite3.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <limits>
#include <map>
#include <new>

#include "studies/file.h"

namespace flyball {
namespace {

namespace fs = std::filesystem;

constexpr int application = 0x666c7962;  // "flyb", in the header of the file
constexpr int version = 1;

/// "name" for SQL.
std::string quoted(const std::string& name) {
  std::string result = "\"";
  for (const char c : name) result.append(c == '"' ? 2 : 1, c);
  return result + '"';
}

/// Columns of a row before those of metrics.
constexpr int first_metric = 5, columns_of_requirement = 5;

std::vector<std::string> column_names(const StoreColumns& columns) {
  std::vector<std::string> names{"run", "key", "status", "reason", "end"};
  for (const std::string& metric : columns.metrics) names.push_back("metric " + metric);
  for (const std::string& requirement : columns.requirements) {
    for (const char* what : {"passed ", "margin ", "value ", "time ", "message "})
      names.push_back(what + requirement);
  }
  return names;
}

/// Holds the right to write; the system takes it back when the process ends, however it ends.
class WriteLock {
 public:
  explicit WriteLock(const fs::path& file) : fd_(::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666)) {
    if (fd_ < 0) throw OutputError(file, "cannot be written", errno);
    if (::flock(fd_, LOCK_EX | LOCK_NB) == 0) return;
    const int error = errno;
    ::close(fd_);
    if (error == EWOULDBLOCK) throw OutputError(file, "another process works on this study", 0);
    throw OutputError(file, "cannot be locked", error);
  }
  ~WriteLock() { ::close(fd_); }
  WriteLock(const WriteLock&) = delete;
  WriteLock& operator=(const WriteLock&) = delete;

 private:
  int fd_;
};

}  // namespace

/// The file and its statements.
class Store::Database {
 public:
  Database(const fs::path& file, Mode mode, const StoreColumns& wanted) : file_(file), mode_(mode) {
    if (mode == Mode::write) lock_.emplace(fs::path(file).replace_extension("lock"));
    // To read what a killed process left takes writing, too: its log is gone through first.
    const int flags = SQLITE_OPEN_READWRITE | (mode == Mode::write ? SQLITE_OPEN_CREATE : 0);
    const int status = sqlite3_open_v2(file.c_str(), &handle_, flags | SQLITE_OPEN_NOMUTEX, nullptr);
    try {
      check(status);
      sqlite3_extended_result_codes(handle_, 1);
      sqlite3_busy_timeout(handle_, patience);
      open(wanted);
    } catch (...) {
      close();
      throw;
    }
  }
  ~Database() { close(); }
  Database(const Database&) = delete;
  Database& operator=(const Database&) = delete;

  /// A statement that is being carried out.
  class Query {
   public:
    Query(const Database& of, sqlite3_stmt* statement) : database_(of), statement_(statement) {}
    ~Query() {
      sqlite3_reset(statement_);
      sqlite3_clear_bindings(statement_);
    }
    Query(const Query&) = delete;
    Query& operator=(const Query&) = delete;

    Query& bind(std::int64_t value) { return checked(sqlite3_bind_int64(statement_, ++bound_, value)); }
    /// SQLite knows no NaN: it is NULL.
    Query& bind(double value) { return checked(sqlite3_bind_double(statement_, ++bound_, value)); }
    Query& bind(const std::string& text) {
      return checked(
          sqlite3_bind_text64(statement_, ++bound_, text.data(), text.size(), SQLITE_STATIC, SQLITE_UTF8));
    }
    Query& skip() {
      ++bound_;
      return *this;
    }
    /// Whether there is a row.
    bool step() {
      errno = 0;
      const int status = sqlite3_step(statement_);
      if (status != SQLITE_ROW && status != SQLITE_DONE) database_.check(status);
      return status == SQLITE_ROW;
    }
    std::int64_t integer(int column) const { return sqlite3_column_int64(statement_, column); }
    double number(int column) const {
      if (sqlite3_column_type(statement_, column) == SQLITE_NULL)
        return std::numeric_limits<double>::quiet_NaN();
      return sqlite3_column_double(statement_, column);
    }
    std::string text(int column) const {
      const auto* text = reinterpret_cast<const char*>(sqlite3_column_text(statement_, column));
      return text == nullptr ? std::string() : std::string(text, sqlite3_column_bytes(statement_, column));
    }

   private:
    Query& checked(int status) {
      database_.check(status);
      return *this;
    }
    const Database& database_;
    sqlite3_stmt* statement_;
    int bound_ = 0;
  };

  /// Prepared once and kept.
  Query query(const std::string& sql) const {
    const auto [found, is_new] = statements_.try_emplace(sql, nullptr);
    if (is_new) check(sqlite3_prepare_v2(handle_, sql.c_str(), -1, &found->second, nullptr));
    return {*this, found->second};
  }
  void run(const std::string& sql) const { query(sql).step(); }

  /// Carries out `work` as a whole or not at all.
  void transaction(auto&& work) const {
    run("BEGIN IMMEDIATE");
    try {
      work();
      run("COMMIT");
    } catch (...) {
      // The error that counts is the first; SQLite may have rolled back by itself.
      sqlite3_exec(handle_, "ROLLBACK", nullptr, nullptr, nullptr);
      throw;
    }
  }

  const StoreColumns& columns() const { return columns_; }
  const std::string& insert_sql() const { return insert_; }
  const std::string& select_sql() const { return select_; }
  /// Whether nobody has written to it.
  bool blank() const { return blank_; }

  /// Leaves nothing beside the file, unless somebody reads at this moment.
  void settle() const {
    run("PRAGMA wal_checkpoint(TRUNCATE)");
    sqlite3_busy_timeout(handle_, 100);
    errno = 0;
    const int status = sqlite3_exec(handle_, "PRAGMA journal_mode = DELETE", nullptr, nullptr, nullptr);
    sqlite3_busy_timeout(handle_, patience);
    if ((status & 0xff) != SQLITE_BUSY && (status & 0xff) != SQLITE_LOCKED) check(status);
  }

 private:
  void check(int status) const {
    if (status == SQLITE_OK) return;
    const int code = status & 0xff;
    if (code == SQLITE_NOMEM || handle_ == nullptr) throw std::bad_alloc();
    if (code == SQLITE_NOTADB || code == SQLITE_CORRUPT)
      throw FileError(file_, "cannot be read as the store of a study; a study begins anew without it", 0);
    // SQLite does not keep the number of an error that comes up while it commits.
    const int error = errno != 0 ? errno : sqlite3_system_errno(handle_);
    const bool of_system = code == SQLITE_IOERR || code == SQLITE_CANTOPEN;
    const std::string what = mode_ == Mode::write ? "cannot be written" : "cannot be read";
    if (code == SQLITE_FULL) throw OutputError(file_, what, ENOSPC);
    if (of_system && error != 0) throw OutputError(file_, what, error);
    throw OutputError(file_, fmt::format("{}: {}", what, sqlite3_errmsg(handle_)), 0);
  }

  void open(const StoreColumns& wanted) {
    const std::int64_t found = pragma("application_id");
    const bool fresh = found == 0 && count_tables() == 0;
    if (!fresh && (found != application || pragma("user_version") != version))
      throw FileError(file_, "is not the store of a study, or of another version of Flyball", 0);
    if (mode_ == Mode::write) {
      // A transaction is in the log, and so safe from the end of the process, when it returns. Waiting for
      // the disk each time would only guard the last runs against a loss of power, and they can be run again.
      run("PRAGMA journal_mode = WAL");
      run("PRAGMA synchronous = NORMAL");
      if (fresh) transaction([&] { create(wanted); });
    }
    blank_ = fresh && mode_ == Mode::read;
    if (!blank_) columns_ = read_columns();
    if (mode_ == Mode::write && columns_ != wanted) {
      transaction([&] { create(wanted); });
      columns_ = wanted;
    }
    make_sql();
  }

  std::int64_t pragma(const std::string& name) const {
    Query value = query("PRAGMA " + name);
    return value.step() ? value.integer(0) : 0;
  }

  std::int64_t count_tables() const {
    Query count = query("SELECT count(*) FROM sqlite_schema");
    return count.step() ? count.integer(0) : 0;
  }

  void create(const StoreColumns& wanted) const {
    run("DROP TABLE IF EXISTS runs");
    run("CREATE TABLE IF NOT EXISTS texts(name TEXT PRIMARY KEY, key INTEGER, text TEXT) WITHOUT ROWID");
    run("DROP TABLE IF EXISTS columns");
    run("CREATE TABLE columns(kind TEXT, name TEXT)");
    for (const auto& [kind, names] :
         {std::pair("metric", &wanted.metrics), std::pair("requirement", &wanted.requirements)}) {
      for (const std::string& name : *names)
        query("INSERT INTO columns VALUES(?, ?)").bind(std::string(kind)).bind(name).step();
    }
    std::string sql = "CREATE TABLE runs(";
    for (const std::string& name : column_names(wanted))
      sql += quoted(name) + (name == "run" ? " INTEGER PRIMARY KEY" : "") + ", ";
    sql.replace(sql.size() - 2, 2, ")");
    run(sql);
    run(fmt::format("PRAGMA application_id = {}", application));
    run(fmt::format("PRAGMA user_version = {}", version));
  }

  StoreColumns read_columns() const {
    StoreColumns columns;
    Query rows = query("SELECT kind, name FROM columns ORDER BY rowid");
    while (rows.step()) {
      const bool metric = rows.text(0) == "metric";
      (metric ? columns.metrics : columns.requirements).push_back(rows.text(1));
    }
    return columns;
  }

  void make_sql() {
    const std::vector<std::string> names = column_names(columns_);
    std::string all, marks;
    for (const std::string& name : names) {
      all += (all.empty() ? "" : ", ") + quoted(name);
      marks += marks.empty() ? "?" : ", ?";
    }
    insert_ = fmt::format("INSERT OR REPLACE INTO runs({}) VALUES({})", all, marks);
    select_ = fmt::format("SELECT {} FROM runs WHERE run >= ? AND run < ? ORDER BY run", all);
  }

  void close() {
    for (const auto& [sql, statement] : statements_) sqlite3_finalize(statement);
    statements_.clear();
    sqlite3_close(handle_);
    handle_ = nullptr;
  }

  static constexpr int patience = 10000;  // ms; others hold the file for moments

  fs::path file_;
  Mode mode_;
  bool blank_ = false;
  std::optional<WriteLock> lock_;
  sqlite3* handle_ = nullptr;
  mutable std::map<std::string, sqlite3_stmt*> statements_;
  StoreColumns columns_;
  std::string insert_, select_;
};

Store::Store(const fs::path& file, Mode mode, const StoreColumns& columns)
    : database_(std::make_unique<Database>(file, mode, columns)) {}
Store::~Store() = default;
Store::Store(Store&&) noexcept = default;

const StoreColumns& Store::columns() const { return database_->columns(); }

void Store::add(std::span<const StoredRun> runs) {
  database_->transaction([&] {
    for (const StoredRun& run : runs) {
      const RunRecord& record = run.record;
      auto row = database_->query(database_->insert_sql());
      row.bind(run.run).bind(static_cast<std::int64_t>(run.key));
      row.bind(static_cast<std::int64_t>(record.status)).bind(record.reason).bind(record.end);
      for (const double metric : record.metrics) row.bind(metric);
      for (const Verdict& verdict : record.verdicts) {
        row.bind(std::int64_t{verdict.passed}).bind(verdict.margin).bind(verdict.value).bind(verdict.time);
        // What passed needs no words.
        verdict.passed ? row.skip() : row.bind(verdict.message);
      }
      row.step();
    }
  });
}

void Store::keys(const std::function<void(std::int64_t, std::uint64_t)>& each) const {
  if (database_->blank()) return;
  auto rows = database_->query("SELECT run, key FROM runs ORDER BY run");
  while (rows.step()) each(rows.integer(0), static_cast<std::uint64_t>(rows.integer(1)));
}

void Store::read(std::int64_t first, std::int64_t last,
                 const std::function<void(const StoredRun&)>& each) const {
  if (database_->blank()) return;
  auto rows = database_->query(database_->select_sql());
  rows.bind(first).bind(last);
  while (rows.step()) {
    StoredRun run{rows.integer(0), static_cast<std::uint64_t>(rows.integer(1)), {}};
    run.record.status = static_cast<RunStatus>(rows.integer(2));
    run.record.reason = rows.text(3);
    run.record.end = rows.number(4);
    int column = first_metric;
    for (std::size_t k = 0; k < columns().metrics.size(); ++k)
      run.record.metrics.push_back(rows.number(column++));
    for (std::size_t k = 0; k < columns().requirements.size(); ++k, column += columns_of_requirement) {
      run.record.verdicts.push_back({rows.integer(column) != 0, rows.number(column + 1),
                                     rows.number(column + 2), rows.number(column + 3),
                                     rows.text(column + 4)});
    }
    each(run);
  }
}

std::int64_t Store::count(RunStatus status) const {
  if (database_->blank()) return 0;
  auto row = database_->query("SELECT count(*) FROM runs WHERE status = ?");
  row.bind(static_cast<std::int64_t>(status));
  return row.step() ? row.integer(0) : 0;
}

void Store::remove_from(std::int64_t first) {
  database_->query("DELETE FROM runs WHERE run >= ?").bind(first).step();
}

std::optional<std::string> Store::text(const std::string& name, std::uint64_t key) const {
  if (database_->blank()) return std::nullopt;
  auto row = database_->query("SELECT text FROM texts WHERE name = ? AND key = ?");
  row.bind(name).bind(static_cast<std::int64_t>(key));
  return row.step() ? std::optional(row.text(0)) : std::nullopt;
}

void Store::keep_text(const std::string& name, std::uint64_t key, const std::string& text) {
  auto row = database_->query("INSERT OR REPLACE INTO texts VALUES(?, ?, ?)");
  row.bind(name).bind(static_cast<std::int64_t>(key)).bind(text).step();
}

void Store::texts(
    const std::function<void(const std::string&, std::uint64_t, const std::string&)>& each) const {
  if (database_->blank()) return;
  auto rows = database_->query("SELECT name, key, text FROM texts ORDER BY name");
  while (rows.step()) each(rows.text(0), static_cast<std::uint64_t>(rows.integer(1)), rows.text(2));
}

void Store::settle() { database_->settle(); }

}  // namespace flyball
