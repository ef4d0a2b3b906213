// The one exception type: its message and its kind.
#include <catch2/catch.hpp>

#include "base/error.h"

using namespace shbake;

TEST_CASE("a message reads file, place, cause, remedy and leaves out what is empty") {
  CHECK(std::string(Error({.file = "a.ply", .place = "line 3", .cause = "no number", .remedy = "mend it"}).what()) ==
        "a.ply: line 3: no number; mend it");
  CHECK(std::string(Error({.file = "a.ply", .cause = "no number"}).what()) == "a.ply: no number");
  CHECK(std::string(Error({.place = "line 3", .cause = "no number"}).what()) == "line 3: no number");
  CHECK(std::string(Error({.cause = "no number", .remedy = "mend it"}).what()) == "no number; mend it");
}

TEST_CASE("errors keep their parts and know what kind they are") {
  const Error work({.file = "a.ply", .cause = "no number"});
  CHECK(work.kind() == ErrorKind::work);
  CHECK(work.parts().file == "a.ply");
  const Error usage = usageError("the order is 99", "choose less");
  CHECK(usage.kind() == ErrorKind::usage);
  CHECK(std::string(usage.what()) == "the order is 99; choose less");
  CHECK(std::string(usageError("the order is 99").what()) == "the order is 99");
  CHECK(cancelledError().kind() == ErrorKind::cancelled);
  CHECK(std::string(cancelledError().what()) == "stopped");
}
