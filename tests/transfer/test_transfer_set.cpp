// Names of the kinds of transfer, and how a transfer set is laid out.
#include <catch2/catch.hpp>
#include <string>

#include "transfer/transfer_set.h"

using namespace shbake;

TEST_CASE("Transfer set: kinds go by their names, spelt exactly") {
  CHECK(std::string(transferName(TransferKind::unshadowed)) == "unshadowed");
  CHECK(std::string(transferName(TransferKind::shadowed)) == "shadowed");
  CHECK(std::string(transferName(TransferKind::interreflected)) == "interreflected");
  for (const TransferKind kind : {TransferKind::unshadowed, TransferKind::shadowed, TransferKind::interreflected}) {
    CHECK(transferKindOf(transferName(kind)) == kind);
  }
  for (const char* word : {"", "Shadowed", "shadowed ", "shadow", "interreflect"}) CHECK_FALSE(transferKindOf(word));
}

TEST_CASE("Transfer set: points, then channels, then coefficients") {
  TransferSet set;
  CHECK(set.size() == 0);
  set.order = 2;
  set.channels = 3;
  for (int i = 0; i < 24; ++i) set.coefficients.push_back(static_cast<float>(i));
  CHECK(set.coefficientsPerChannel() == 4);
  CHECK(set.stride() == 12);
  CHECK(set.size() == 2);
  CHECK(set.at(1, 2)[3] == 23);
  CHECK(set.at(1, 0)[0] == 12);
  CHECK(set.at(0, 1).size() == 4);
}
