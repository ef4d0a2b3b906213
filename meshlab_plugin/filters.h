// What the plugin's filters and its file format do, whatever release of MeshLab calls them.
#pragma once

#include <QString>
#include <functional>
#include <string>
#include <vector>

#include "meshlab_plugin/bridge.h"
#include "meshlab_plugin/light_choice.h"
#include "shbake.h"

class MeshDocument;
class RichParameterList;

namespace shbake::meshlab {

enum class Filter { bake, refine, relight, save };

/// What menus, help and scripts show of a filter.
struct FilterText {
  Filter filter;
  QString name;        ///< in menus and scripts
  QString pythonName;  ///< for PyMeshLab
  QString help;        ///< HTML
};
/// All filters, in the order of the menu.
const std::vector<FilterText>& filterTexts();

/// Declares the parameters of a filter for a layer, which may be null.
void declareParameters(Filter filter, const MeshModel* layer, RichParameterList& parameters);

/// What MeshLab must know has changed: bits of MeshModel::MeshElement. Relighting changes nothing but colours, which is
/// what lets MeshLab offer its preview.
int changesOf(Filter filter);

/// Told how far the work is, 0..100, and what is being done; returns false to cancel.
using Watch = std::function<bool(int percent, const std::string& text)>;

/// The filters with what they keep between calls.
class Filters {
 public:
  /// Applies a filter to the document's current layer. Returns what there is to tell, a sentence a line. Throws an
  /// Error, also when a filter is running already: MeshLab handles clicks while it waits for one.
  std::vector<std::string> apply(Filter filter, MeshDocument& document, const RichParameterList& parameters,
                                 const Watch& watch);

  /// Reads a baked file into an empty layer; returns the bits of vcg::tri::io::Mask of what it holds.
  int load(const std::string& path, MeshModel& layer, const Watch& watch);
  /// Writes a baked layer as a file, with its own colours.
  void save(const std::string& path, MeshModel& layer, bool ascii, const Watch& watch);

 private:
  std::vector<std::string> bake(MeshDocument& document, const RichParameterList& parameters, const Watch& watch);
  std::vector<std::string> refineLayer(MeshModel& layer, const RichParameterList& parameters, const Watch& watch);
  std::vector<std::string> relightLayer(MeshModel& layer, const RichParameterList& parameters, const Watch& watch);
  void write(const std::string& path, MeshModel& layer, SavedColors colors, bool ascii, const Watch& watch);

  LightMaker lights_;
  bool running_ = false;
};

/// The words of any exception, for messages.
std::string describeFailure(const std::exception& failure);

}  // namespace shbake::meshlab
