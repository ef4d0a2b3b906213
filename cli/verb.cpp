// The list of verbs.
#include "cli/verb.h"

#include <array>
#include <cstdio>

namespace shbake::cli {

// One line a verb, in the order of help; verbs/NAME.cpp defines NAMEVerb.
#define SHBAKE_VERBS(VERB) \
  VERB(bake)               \
  VERB(refine)             \
  VERB(info)               \
  VERB(compare)            \
  VERB(chart)              \
  VERB(light)              \
  VERB(sh)                 \
  VERB(relight)            \
  VERB(render)             \
  VERB(selftest)

#define SHBAKE_DECLARE(name) extern const VerbEntry name##Verb;
SHBAKE_VERBS(SHBAKE_DECLARE)
#undef SHBAKE_DECLARE

std::span<const VerbEntry* const> allVerbs() {
#define SHBAKE_ENTRY(name) &name##Verb,
  static constexpr std::array kVerbs{SHBAKE_VERBS(SHBAKE_ENTRY)};
#undef SHBAKE_ENTRY
  return kVerbs;
}

void Session::warn(const std::string& sentence) {
  display.clearLine();
  std::fprintf(stderr, "shbake: warning: %s\n", sentence.c_str());
  warnings.push_back(sentence);
  report.data("warnings", warnings);
}

}  // namespace shbake::cli
