#include "airsim360/dataset/index.h"

#include "airsim360/dataset/index_schema.h"
#include "airsim360/dataset/sqlite.h"

namespace airsim360 {

using internal::Database;
using internal::Statement;
using internal::Transaction;

struct DatasetIndex::Impl {
  mutable Database database;
};

DatasetIndex::DatasetIndex(const std::filesystem::path& folder, Mode mode)
    : impl_(new Impl{Database(folder / kIndexName, mode == Mode::kRead ? Database::Mode::kRead : Database::Mode::kWrite)}) {
  Database& database = impl_->database;
  if (mode == Mode::kJournal) {
    database.Run("PRAGMA journal_mode=DELETE; PRAGMA synchronous=FULL");
    Statement tables(database, "SELECT COUNT(*) FROM sqlite_master");
    if (tables.Next() && tables.Int(0) == 0) internal::CreateIndexSchema(database);
  }
  internal::CheckIsIndex(database);
}

DatasetIndex::~DatasetIndex() = default;

void DatasetIndex::AddFrame(const FrameRecord& frame, const std::string& json) {
  Transaction transaction(impl_->database);
  const Quaternion q = ToQuaternion(frame.X_WC.R);
  Statement row(impl_->database, "INSERT INTO frames VALUES(?,?,?,?,?,?,?,?,?,?,?,?,?)");
  row.Bind(0, frame.index).Bind(1, Stem(frame.index)).Bind(2, frame.t_ns);
  row.Bind(3, frame.X_WC.p.x).Bind(4, frame.X_WC.p.y).Bind(5, frame.X_WC.p.z);
  row.Bind(6, q.w).Bind(7, q.x).Bind(8, q.y).Bind(9, q.z);
  row.Bind(10, frame.range_min).Bind(11, frame.range_median).Bind(12, json).Run();

  Statement file(impl_->database, "INSERT INTO files VALUES(?,?,?,?,?,?)");
  for (size_t i = 0; i < frame.files.size(); ++i) {
    const FileRecord& f = frame.files[i];
    file.Bind(0, frame.index).Bind(1, static_cast<int64_t>(i)).Bind(2, f.key).Bind(3, f.path);
    file.Bind(4, f.bytes).Bind(5, f.sha256).Run();
  }
  Statement segment(impl_->database, "INSERT INTO segments VALUES(?,?,?,?,?,?,?,?,?,?,?,?)");
  for (const ViewRecord& view : frame.views) {
    for (const Segment& s : view.segments) {
      segment.Bind(0, frame.index).Bind(1, view.suffix).Bind(2, int64_t{s.entity}).Bind(3, int64_t{s.category});
      segment.Bind(4, s.area).Bind(5, int64_t{s.box.x}).Bind(6, int64_t{s.box.y}).Bind(7, int64_t{s.box.w});
      segment.Bind(8, int64_t{s.box.h}).Bind(9, int64_t{s.box_wrap.x}).Bind(10, int64_t{s.box_wrap.w});
      segment.Bind(11, s.solid_angle).Run();
    }
  }
  Statement person(impl_->database, "INSERT INTO persons VALUES(?,?,?,?,?,?,?,?,?)");
  for (const ViewRecord& view : frame.views) {
    for (const PersonRow& p : view.persons) {
      person.Bind(0, frame.index).Bind(1, view.suffix).Bind(2, int64_t{p.entity}).Bind(3, p.track);
      person.Bind(4, p.behaviour).Bind(5, p.range).Bind(6, p.pixels).Bind(7, p.visible_fraction);
      person.Bind(8, p.json).Run();
    }
  }
  transaction.Commit();
}

void DatasetIndex::RemoveFrame(int64_t index) {
  Transaction transaction(impl_->database);
  for (const char* table : {"frames", "files", "segments", "persons"}) {
    Statement(impl_->database, std::string("DELETE FROM ") + table + " WHERE frame=?").Bind(0, index).Run();
  }
  transaction.Commit();
}

std::vector<int64_t> DatasetIndex::Frames() const {
  std::vector<int64_t> frames;
  Statement rows(impl_->database, "SELECT frame FROM frames ORDER BY frame");
  while (rows.Next()) frames.push_back(rows.Int(0));
  return frames;
}

std::vector<FileRecord> DatasetIndex::Files(int64_t frame) const {
  std::vector<FileRecord> files;
  Statement rows(impl_->database, "SELECT key, path, bytes, sha256 FROM files WHERE frame=? ORDER BY position");
  rows.Bind(0, frame);
  while (rows.Next()) files.push_back({rows.Text(0), rows.Text(1), rows.Int(2), rows.Text(3)});
  return files;
}

std::string DatasetIndex::FrameLine(int64_t frame) const {
  Statement row(impl_->database, "SELECT json FROM frames WHERE frame=?");
  row.Bind(0, frame);
  return row.Next() ? row.Text(0) : std::string();
}

std::vector<Segment> DatasetIndex::Segments(int64_t frame, const std::string& view) const {
  std::vector<Segment> segments;
  Statement rows(impl_->database,
                 "SELECT entity, category, area, x, y, w, h, wrap_x, wrap_w, solid_angle FROM segments "
                 "WHERE frame=? AND view=? ORDER BY entity");
  rows.Bind(0, frame).Bind(1, view);
  while (rows.Next()) {
    const auto integer = [&](int column) { return static_cast<int>(rows.Int(column)); };
    const PixelBox box{integer(3), integer(4), integer(5), integer(6)};
    segments.push_back({static_cast<EntityId>(rows.Int(0)),
                        static_cast<CategoryId>(rows.Int(1)),
                        rows.Int(2),
                        box,
                        {integer(7), box.y, integer(8), box.h},
                        rows.Real(9)});
  }
  return segments;
}

std::vector<std::string> DatasetIndex::Persons(int64_t frame, const std::string& view) const {
  std::vector<std::string> persons;
  Statement rows(impl_->database, "SELECT json FROM persons WHERE frame=? AND view=? ORDER BY entity");
  rows.Bind(0, frame).Bind(1, view);
  while (rows.Next()) persons.push_back(rows.Text(0));
  return persons;
}

PeopleTotals DatasetIndex::CountPeople() const {
  const auto count = [&](const std::string& what) {
    Statement row(impl_->database, "SELECT COUNT(" + what + ") FROM persons");
    return row.Next() ? row.Int(0) : 0;
  };
  return {.views = count("*"),
          .views_seen = count("CASE WHEN pixels > 0 THEN 1 END"),
          .persons_seen = count("DISTINCT CASE WHEN pixels > 0 THEN track END"),
          .persons_large = count("DISTINCT CASE WHEN pixels >= " + std::to_string(kLargePerson) + " THEN track END")};
}

std::vector<CategoryTotal> DatasetIndex::CategoryTotals() const {
  std::vector<CategoryTotal> totals;
  Statement rows(impl_->database,
                 "SELECT category, SUM(area), SUM(solid_angle), COUNT(DISTINCT entity) FROM "
                 "(SELECT * FROM segments ORDER BY frame, view, entity) GROUP BY category ORDER BY category");
  while (rows.Next()) totals.push_back({static_cast<CategoryId>(rows.Int(0)), rows.Int(1), rows.Real(2), rows.Int(3)});
  return totals;
}

std::vector<SeenEntity> DatasetIndex::SeenEntities() const {
  std::vector<SeenEntity> seen;
  Statement rows(impl_->database, "SELECT entity, MIN(frame) FROM segments GROUP BY entity ORDER BY entity");
  while (rows.Next()) seen.push_back({static_cast<EntityId>(rows.Int(0)), rows.Int(1)});
  return seen;
}

std::vector<DatasetIndex::NamedEntity> DatasetIndex::Entities() const {
  std::vector<NamedEntity> entities;
  Statement rows(impl_->database, "SELECT entity, name, category FROM entities ORDER BY entity");
  while (rows.Next()) entities.push_back({static_cast<EntityId>(rows.Int(0)), rows.Text(1), static_cast<CategoryId>(rows.Int(2))});
  return entities;
}

void DatasetIndex::Take(const std::filesystem::path& other) {
  Statement(impl_->database, "ATTACH ? AS other").Bind(0, (other / kIndexName).string()).Run();
  {
    Transaction transaction(impl_->database);
    impl_->database.Run(
        "CREATE TEMP TABLE new_frames AS SELECT frame FROM other.frames WHERE frame NOT IN (SELECT frame FROM main.frames)");
    for (const std::string table : {"frames", "files", "segments", "persons"}) {
      impl_->database.Run("INSERT INTO main." + table + " SELECT * FROM other." + table + " WHERE frame IN (SELECT frame FROM new_frames)");
    }
    impl_->database.Run("DROP TABLE new_frames");
    transaction.Commit();
  }
  impl_->database.Run("DETACH other");
}

}  // namespace airsim360
