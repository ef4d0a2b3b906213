// Names of files: the extension, whatever its case.
#include <catch2/catch.hpp>

#include "base/file_name.h"

using namespace shbake;

TEST_CASE("an extension is told in lower case, with its dot", "[file_name]") {
  CHECK(lowerExtension("room.ply") == ".ply");
  CHECK(lowerExtension("/scans/Room.OBJ") == ".obj");
  CHECK(lowerExtension("a.tar.GZ") == ".gz");
  CHECK(lowerExtension("room.") == ".");
}

TEST_CASE("a name without a dot of its own has no extension", "[file_name]") {
  CHECK(lowerExtension("").empty());
  CHECK(lowerExtension("room").empty());
  CHECK(lowerExtension("scans.v2/room").empty());
  CHECK(lowerExtension(".ply").empty());
}

TEST_CASE("bytes that are no letters stay as they are in an extension", "[file_name]") {
  CHECK(lowerExtension("a.\xC3\x84"
                       "B") ==
        ".\xC3\x84"
        "b");
}
