#include "transfer/baked_ply.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/error.h"
#include "base/passes.h"
#include "mesh/ply_columns.h"
#include "mesh/ply_reader.h"
#include "mesh/ply_writer.h"
#include "sh/basis.h"
#include "transfer/sh_columns.h"
#include "transfer/transfer_facts.h"

namespace shbake {
namespace {

[[noreturn]] void fail(const std::string& file, std::string place, std::string cause, std::string remedy) {
  throw Error({.file = file, .place = std::move(place), .cause = std::move(cause), .remedy = std::move(remedy)});
}

void requireItems(std::size_t items, std::size_t vertices, const char* what) {
  if (items == vertices) return;
  throw usageError("there are " + std::to_string(items) + " " + what + " for " + std::to_string(vertices) +
                   " vertices");
}

void requireFinite(const std::vector<float>& values, std::size_t perVertex, const char* what, Passes& passes) {
  passes.forEach(values.size(), [&](std::size_t i) {
    if (std::isfinite(values[i])) return;
    throw usageError(std::string("the ") + what + " of vertex " + std::to_string(i / perVertex) + " is not finite");
  });
}

bool isShare(float value) {
  return value >= 0 && value <= 1;
}

void requireWritable(const Mesh& mesh, const TransferSet& transfer, std::span<const std::uint32_t> sourceVertex,
                     Progress& progress) {
  const std::size_t vertices = mesh.positions.size();
  if (transfer.order < 1 || (transfer.channels != 1 && transfer.channels != 3)) {
    throw usageError("a transfer has an order of 1 or more and 1 or 3 channels");
  }
  requireItems(mesh.vertexNormals.size(), vertices, "normals");
  requireItems(transfer.coefficients.size(), vertices * transfer.stride(), "coefficients");
  // Coefficients, errors, visibilities, their range, source vertices.
  Passes passes(progress, "checking results", vertices, "vertices", 5);
  requireFinite(transfer.coefficients, transfer.stride(), "transfer", passes);
  for (const auto& [values, what] : {std::pair(&transfer.error, "error"), {&transfer.visibility, "visibility"}}) {
    if (values->empty()) continue;
    requireItems(values->size(), vertices, what);
    requireFinite(*values, 1, what, passes);
  }
  passes.forEach(transfer.visibility.size(), [&](std::size_t v) {
    if (!isShare(transfer.visibility[v])) throw usageError("a visibility is outside 0..1");
  });
  if (!sourceVertex.empty()) requireItems(sourceVertex.size(), vertices, "source vertices");
  passes.forEach(sourceVertex.size(), [&](std::size_t v) {
    constexpr std::uint32_t kLargest = std::numeric_limits<std::int32_t>::max();
    if (sourceVertex[v] > kLargest && sourceVertex[v] != kNewVertex) throw usageError("a source vertex is beyond the range of int");
  });
  passes.end();
}

void addTransferColumns(PlyElementView& vertices, const TransferSet& transfer,
                        std::span<const std::uint32_t> sourceVertex) {
  const auto addFloats = [&](std::string name, const float* first, std::size_t stride) {
    vertices.columns.push_back(viewScalars(std::move(name), ScalarType::float32, first, stride * sizeof(float)));
  };
  if (!transfer.visibility.empty()) addFloats("quality", transfer.visibility.data(), 1);
  const int count = transfer.coefficientsPerChannel();
  for (int channel = 0; channel < transfer.channels; ++channel) {
    for (int i = 0; i < count; ++i) {
      addFloats(shColumnName(transfer.channels, channel, i), transfer.coefficients.data() + channel * count + i,
                transfer.stride());
    }
  }
  if (!transfer.error.empty()) addFloats("sh_error", transfer.error.data(), 1);
  if (!sourceVertex.empty()) {
    vertices.columns.push_back(
        viewScalars("source_vertex", ScalarType::int32, sourceVertex.data(), sizeof(std::uint32_t)));
  }
}

/// The declared properties of a mesh's vertices.
std::vector<PlyProperty> declarations(const std::vector<Property>& columns) {
  std::vector<PlyProperty> result;
  for (const Property& c : columns) result.push_back({c.name, c.type, c.isList, c.countType});
  return result;
}

/// Moves what belongs to the transfer from a mesh to a transfer set.
class TransferReader {
 public:
  TransferReader(BakedPly& baked, const StatedFacts& stated, Progress& progress)
      : baked_(baked),
        stated_(stated),
        file_(baked.mesh.source),
        vertices_(baked.mesh.positions.size()),
        progress_(progress) {}

  void read() {
    progress_.begin("unpacking", static_cast<double>(vertices_), "vertices");
    takeCoefficients();
    takeErrors();
    takeVisibility();
    takeSourceVertices();
    progress_.end();
  }

 private:
  void takeCoefficients() {
    std::vector<Property>& columns = baked_.mesh.vertexProperties;
    const auto found = findShColumns(declarations(columns), stated_, file_);
    if (!found) {
      fail(file_, "header", "its vertices have no coefficients (sh_0 … or sh_r_0 …)", "bake the mesh first");
    }
    TransferSet& transfer = baked_.transfer;
    transfer.order = found->order;
    transfer.channels = found->channels;
    transfer.coefficients.resize(vertices_ * transfer.stride());
    std::vector<Property> kept;
    for (std::size_t c = 0; c < columns.size(); ++c) {
      if (found->place[c]) {
        readColumn(std::exchange(columns[c], {}), *found->place[c]);
      } else {
        kept.push_back(std::move(columns[c]));
      }
    }
    columns = std::move(kept);
  }

  /// Copies one coefficient of all vertices; the column is freed on return.
  void readColumn(const Property column, std::size_t place) {
    const std::size_t stride = baked_.transfer.stride();
    const int index = static_cast<int>(place % static_cast<std::size_t>(baked_.transfer.coefficientsPerChannel()));
    const bool negate = stated_.condonShortley && sh::orderOf(index) % 2 != 0;
    float* const to = baked_.transfer.coefficients.data() + place;
    const double share = static_cast<double>(vertices_) / static_cast<double>(stride);
    forEachCounted(progress_, vertices_, share, [&](std::size_t v) {
      const auto value = static_cast<float>(scalarAt(column, v));
      if (!std::isfinite(value)) failValue(column.name, v, "is not finite");
      to[v * stride] = negate ? -value : value;
    });
  }

  [[noreturn]] void failValue(const std::string& name, std::size_t vertex, const std::string& what) const {
    fail(file_, "vertex " + std::to_string(vertex), "its " + name + " " + what, "bake the mesh anew");
  }

  /// A scalar column of floats, or nothing when there is none. A column of that name that is anything else stays with
  /// the mesh and is noted.
  std::optional<Property> takeFloats(const char* name) {
    const Property* p = findColumn(baked_.mesh.vertexProperties, name);
    if (!p) return {};
    if (p->isList || !isFloatType(p->type)) {
      baked_.notes.push_back(std::string("property ") + name + " is not a float and was left as it is");
      return {};
    }
    return takeColumn(baked_.mesh.vertexProperties, name);
  }

  void takeErrors() {
    const auto column = takeFloats("sh_error");
    if (!column) return;
    baked_.transfer.error.resize(vertices_);
    forEachCounted(progress_, vertices_, 0, [&](std::size_t v) {
      const auto value = static_cast<float>(scalarAt(*column, v));
      if (!(value >= 0 && std::isfinite(value))) failValue("sh_error", v, "is not a finite number of 0 or more");
      baked_.transfer.error[v] = value;
    });
  }

  void takeVisibility() {
    if (!stated_.any) return;
    auto column = takeFloats("quality");
    if (!column) return;
    std::vector<float> values(vertices_);
    forEachCounted(progress_, vertices_, 0,
                   [&](std::size_t v) { values[v] = static_cast<float>(scalarAt(*column, v)); });
    if (std::ranges::all_of(values, isShare)) {
      baked_.transfer.visibility = std::move(values);
      return;
    }
    baked_.notes.push_back(
        "property quality is not within 0..1, so it is not the visible share of the sky; it was left as "
        "it is");
    baked_.mesh.vertexProperties.push_back(std::move(*column));
  }

  void takeSourceVertices() {
    const Property* p = findColumn(baked_.mesh.vertexProperties, "source_vertex");
    if (!p) return;
    if (p->isList || isFloatType(p->type)) {
      baked_.notes.push_back("property source_vertex is not an integer and was left as it is");
      return;
    }
    const Property column = *takeColumn(baked_.mesh.vertexProperties, "source_vertex");
    const std::size_t stated = baked_.facts.sourceVertices;
    const double limit = stated > 0 ? static_cast<double>(stated) : 0x1p32;
    baked_.sourceVertex.resize(vertices_);
    forEachCounted(progress_, vertices_, 0, [&](std::size_t v) {
      const double value = scalarAt(column, v);
      if (value == -1) {
        baked_.sourceVertex[v] = kNewVertex;
        return;
      }
      if (value < 0 || value >= limit) {
        fail(file_, "vertex " + std::to_string(v),
             "its source_vertex is " + std::to_string(static_cast<std::int64_t>(value)) +
                 (stated > 0 ? ", but source_vertices=" + std::to_string(stated) : ""),
             "correct the comment, or bake the mesh anew");
      }
      baked_.sourceVertex[v] = static_cast<std::uint32_t>(value);
    });
  }

  BakedPly& baked_;
  const StatedFacts& stated_;
  const std::string& file_;
  std::size_t vertices_;
  Progress& progress_;
};

void noteConversion(bool condonShortley, std::vector<std::string>& notes) {
  if (condonShortley) {
    notes.push_back(
        "the coefficients have Condon-Shortley phase (condon_shortley=1): those of odd m change their sign");
  }
}

}  // namespace

void writeBakedPly(const std::string& path, const Mesh& mesh, const TransferSet& transfer, const TransferFacts& facts,
                   std::span<const std::uint32_t> sourceVertex, const BakedPlyOptions& options, Progress& progress) {
  requireWritable(mesh, transfer, sourceVertex, progress);
  PlyMeshView view = viewMesh(mesh);
  PlyElementView& vertices = view.elements[0];
  std::erase_if(vertices.columns, [](const PlyColumnView& c) { return isTransferColumn(c.property.name); });
  std::erase_if(view.elements[1].columns, [](const PlyColumnView& c) { return c.property.name == "corner_normals"; });
  addTransferColumns(vertices, transfer, sourceVertex);
  std::vector<std::string> comments = factComments(facts, transfer.order, transfer.channels);
  std::ranges::remove_copy_if(mesh.comments, std::back_inserter(comments), isFactComment);
  writePlyElements(path, options.ascii ? PlyEncoding::ascii : PlyEncoding::binaryLittleEndian, comments, view.elements,
                   progress);
}

BakedPly readBakedPly(const std::string& path, Progress& progress) {
  BakedPly baked;
  baked.mesh = readPly(path, progress);
  StatedFacts stated = parseFacts(baked.mesh.comments, path);
  baked.facts = stated.facts;
  baked.stated = stated.any;
  baked.notes = stated.notes;
  noteConversion(stated.condonShortley, baked.notes);
  TransferReader(baked, stated, progress).read();
  std::erase_if(baked.mesh.comments, isFactComment);
  return baked;
}

std::optional<BakedPlyInfo> readBakedPlyInfo(const std::string& path) {
  BakedPlyInfo info;
  info.header = readPlyHeader(path);
  const PlyElement* vertices = info.header.find("vertex");
  if (!vertices) return {};
  const StatedFacts stated = parseFacts(info.header.comments, path);
  const auto columns = findShColumns(vertices->properties, stated, path);
  if (!columns) return {};
  info.order = columns->order;
  info.channels = columns->channels;
  info.facts = stated.facts;
  info.stated = stated.any;
  info.condonShortley = stated.condonShortley;
  info.hasError = vertices->find("sh_error");
  info.hasVisibility = stated.any && vertices->find("quality");
  info.hasSourceVertex = vertices->find("source_vertex");
  info.notes = stated.notes;
  noteConversion(stated.condonShortley, info.notes);
  return info;
}

bool isBakedPly(const std::string& path) {
  try {
    return readBakedPlyInfo(path).has_value();
  } catch (const Error&) {
    return false;
  }
}

}  // namespace shbake
