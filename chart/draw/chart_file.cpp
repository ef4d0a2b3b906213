// Charts as files.
#include "chart/draw/chart_file.h"

#include "base/atomic_file.h"
#include "base/error.h"
#include "base/file_name.h"
#include "chart/draw/chart_json.h"
#include "chart/draw/gnuplot.h"
#include "chart/draw/gnuplot_script.h"
#include "chart/draw/page.h"
#include "chart/draw/panels.h"

namespace shbake::chart {

ChartFormat chartFormatOf(const std::string& path) {
  const std::string end = lowerExtension(path);
  if (end == ".html" || end == ".htm") return ChartFormat::html;
  if (end == ".svg") return ChartFormat::svg;
  if (end == ".png") return ChartFormat::png;
  if (end == ".json") return ChartFormat::json;
  throw Error({.kind = ErrorKind::usage,
               .file = path,
               .cause = "'" + end + "' is not a format of charts",
               .remedy = "name the output .html, .svg, .png or .json"});
}

std::string drawChart(const ChartData& data, ChartFormat format, Progress& progress) {
  if (format == ChartFormat::json) return chartJson(data);
  progress.begin("drawing", 0, "");
  std::string bytes;
  if (format == ChartFormat::html) {
    bytes = chartPage(data, [&](const Panel& panel) {
      return runGnuplot(gnuplotScript({&panel, 1}, "", PictureFormat::svg), progress);
    });
  } else {
    const bool svg = format == ChartFormat::svg;
    bytes = runGnuplot(gnuplotScript(panelsOf(data), "Speed and accuracy of " + data.mesh,
                                     svg ? PictureFormat::svg : PictureFormat::png),
                       progress);
  }
  progress.end();
  return bytes;
}

void writeChart(const std::string& path, const ChartData& data, Progress& progress) {
  const std::string bytes = drawChart(data, chartFormatOf(path), progress);
  AtomicFile file(path);
  file.write(bytes);
  file.commit();
}

}  // namespace shbake::chart
