// The tables of index.sqlite.
#pragma once

#include "airsim360/dataset/sqlite.h"

namespace airsim360::internal {

/// Creates the tables in a database that has none yet, and marks it as an index.
void CreateIndexSchema(Database& database);

/// RuntimeError naming the file unless the database is marked as an index.
void CheckIsIndex(Database& database);

}  // namespace airsim360::internal
