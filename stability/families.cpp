// The list of families.
#include "stability/families.h"

#include <array>
#include <string>

namespace shbake::stability {
namespace {

struct Family {
  std::string_view name;
  std::span<const Row> (*rows)();
};

constexpr std::array kFamilies{
    Family{"sh", shRows},           Family{"light", lightRows}, Family{"tracing", tracingRows},
    Family{"contact", contactRows}, Family{"meshes", meshRows}, Family{"energy", energyRows},
    Family{"scale", scaleRows},
};

}  // namespace

std::vector<std::string_view> familyNames() {
  std::vector<std::string_view> names;
  for (const Family& family : kFamilies) names.push_back(family.name);
  return names;
}

std::vector<const Row*> rowsOf(std::string_view family) {
  std::vector<const Row*> rows;
  for (const Family& f : kFamilies) {
    if (!family.empty() && f.name != family) continue;
    for (const Row& row : f.rows()) rows.push_back(&row);
  }
  if (!rows.empty()) return rows;
  std::string names;
  for (const Family& f : kFamilies) names += (names.empty() ? "" : ", ") + std::string(f.name);
  throw usageError("there is no family of rows called '" + std::string(family) + "'", "give one of " + names);
}

}  // namespace shbake::stability
