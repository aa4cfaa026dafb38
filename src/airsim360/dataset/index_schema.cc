#include "airsim360/dataset/index_schema.h"

#include "airsim360/base/error.h"

namespace airsim360::internal {
namespace {

constexpr char kSchema[] = R"(
CREATE TABLE frames(frame INTEGER PRIMARY KEY, stem TEXT, t_ns INTEGER, x REAL, y REAL, z REAL,
  qw REAL, qx REAL, qy REAL, qz REAL, range_min REAL, range_median REAL, json TEXT);
CREATE TABLE files(frame INTEGER, position INTEGER, key TEXT, path TEXT, bytes INTEGER, sha256 TEXT,
  PRIMARY KEY(frame, position)) WITHOUT ROWID;
CREATE TABLE segments(frame INTEGER, view TEXT, entity INTEGER, category INTEGER, area INTEGER,
  x INTEGER, y INTEGER, w INTEGER, h INTEGER, wrap_x INTEGER, wrap_w INTEGER, solid_angle REAL,
  PRIMARY KEY(frame, view, entity)) WITHOUT ROWID;
CREATE TABLE persons(frame INTEGER, view TEXT, entity INTEGER, track INTEGER, behaviour TEXT, range REAL,
  pixels INTEGER, visible_fraction REAL, json TEXT, PRIMARY KEY(frame, view, entity)) WITHOUT ROWID;
CREATE TABLE categories(category INTEGER PRIMARY KEY, path TEXT, parent INTEGER, kind TEXT);
CREATE TABLE entities(entity INTEGER PRIMARY KEY, name TEXT, category INTEGER, first_frame INTEGER);
CREATE VIEW frame_categories AS SELECT frame, category, path, SUM(area) AS pixels, SUM(solid_angle) AS solid_angle,
  COUNT(DISTINCT entity) AS entities FROM segments JOIN categories USING(category) GROUP BY frame, category;
)";

constexpr int64_t kApplicationId = 0x41533336;  // "AS36"

}  // namespace

void CreateIndexSchema(Database& database) {
  Transaction transaction(database);
  database.Run("PRAGMA application_id=" + std::to_string(kApplicationId));
  database.Run(kSchema);
  transaction.Commit();
}

void CheckIsIndex(Database& database) {
  Statement statement(database, "PRAGMA application_id");
  if (!statement.Next() || statement.Int(0) != kApplicationId) {
    throw RuntimeError(database.path().string() + ": not a dataset index");
  }
}

}  // namespace airsim360::internal
