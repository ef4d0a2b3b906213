// Short texts drawn into pictures, without a font file.
#pragma once

#include <string_view>

#include "base/vec3.h"
#include "view/picture.h"

namespace shbake {

/// Where in a picture, in pixels from its upper left corner.
struct PicturePlace {
  double x = 0, y = 0;
};

/// Draws one line of text centred on `centre` in letters of `size` pixels from baseline to the top of a capital.
/// Letters are strokes with round ends, drawn in lower case; characters other than letters, digits, blank and . , - + /
/// : ( ) = % leave a blank. What reaches beyond the picture is cut off.
void drawCaption(Picture& picture, std::string_view text, const PicturePlace& centre, double size, const Rgb& ink);

}  // namespace shbake
