// Values of parameters, checked: MeshLab checks no ranges itself, neither in its window nor in scripts. All of these
// throw a usage error that names the parameter by its label, what it has, and what it may have.
#pragma once

#include <string>
#include <vector>

#include "shbake.h"

class RichParameterList;

namespace shbake::meshlab {

/// The number that a person typed to get this float: 0.01f becomes 0.01, not 0.00999999978.
double typedNumber(float value);

int wholeOf(const RichParameterList& parameters, const char* name, const char* label, int least, int most);

/// A number as it was typed.
double realOf(const RichParameterList& parameters, const char* name, const char* label, double least, double most);

/// As realOf(), of a slider.
double sliderOf(const RichParameterList& parameters, const char* name, const char* label, double least, double most);

/// A length that is given absolutely or in per cent, > 0.
double lengthOf(const RichParameterList& parameters, const char* name, const char* label);

/// A text of one share, or of three with commas, each 0..1.
Rgb sharesOf(const RichParameterList& parameters, const char* name, const char* label);

/// The place of a choice in its list, below `count`.
std::size_t placeOf(const RichParameterList& parameters, const char* name, const char* label, std::size_t count);

/// The value at the place of a choice.
template <class T>
T choiceOf(const RichParameterList& parameters, const char* name, const char* label, const std::vector<T>& values) {
  return values[placeOf(parameters, name, label, values.size())];
}

}  // namespace shbake::meshlab
