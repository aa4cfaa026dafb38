// The finished index: a file whose bytes depend on its rows alone.
#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "airsim360/base/error.h"
#include "airsim360/dataset/index.h"
#include "airsim360/dataset/index_schema.h"

namespace airsim360 {

using internal::Database;
using internal::Statement;
using internal::Transaction;

namespace {

void InsertNames(Database& database, const Scene& scene) {
  Statement category(database, "INSERT INTO categories VALUES(?,?,?,?)");
  for (const auto& [id, entry] : scene.tree.categories()) {
    if (id == kVoid) continue;
    category.Bind(0, int64_t{id}).Bind(1, entry.path).Bind(2, int64_t{entry.parent});
    category.Bind(3, std::string_view(entry.thing ? "thing" : "stuff")).Run();
  }
  Statement seen(database, "SELECT entity, category, MIN(frame) FROM segments GROUP BY entity ORDER BY entity");
  Statement entity(database, "INSERT INTO entities VALUES(?,?,?,?)");
  while (seen.Next()) {
    const std::string& name = scene.entity(static_cast<EntityId>(seen.Int(0))).name;
    entity.Bind(0, seen.Int(0)).Bind(1, name).Bind(2, seen.Int(1)).Bind(3, seen.Int(2)).Run();
  }
}

// Makes a finished file durable and gives it its name.
void PublishFile(const std::filesystem::path& temporary, const std::filesystem::path& path) {
  const int fd = ::open(temporary.c_str(), O_RDONLY | O_CLOEXEC);
  int error = fd < 0 || ::fsync(fd) != 0 ? errno : 0;
  if (fd >= 0) ::close(fd);
  if (error == 0 && ::rename(temporary.c_str(), path.c_str()) != 0) error = errno;
  if (error != 0) throw RuntimeError(path.string() + ": cannot write: " + std::strerror(error));
}

}  // namespace

void DatasetIndex::Finish(const std::filesystem::path& folder, const Scene& scene) {
  const std::filesystem::path path = folder / kIndexName, temporary = path.string() + ".tmp";
  std::filesystem::remove(temporary);
  try {
    // A new file, filled in order in one go: its bytes depend on the rows alone.
    Database database(temporary, Database::Mode::kWrite);
    database.Run("PRAGMA page_size=4096; PRAGMA journal_mode=OFF; PRAGMA synchronous=OFF");
    internal::CreateIndexSchema(database);
    Statement(database, "ATTACH ? AS journal").Bind(0, path.string()).Run();
    {
      Transaction transaction(database);
      database.Run("INSERT INTO main.frames SELECT * FROM journal.frames ORDER BY frame");
      database.Run("INSERT INTO main.files SELECT * FROM journal.files ORDER BY frame, position");
      database.Run("INSERT INTO main.segments SELECT * FROM journal.segments ORDER BY frame, view, entity");
      database.Run("INSERT INTO main.persons SELECT * FROM journal.persons ORDER BY frame, view, entity");
      InsertNames(database, scene);
      transaction.Commit();
    }
    database.Run("DETACH journal");
  } catch (...) {
    std::error_code ignored;
    std::filesystem::remove(temporary, ignored);
    throw;
  }
  PublishFile(temporary, path);
}

}  // namespace airsim360
