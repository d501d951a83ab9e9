#include "obj_faces.h"

#include <tiny_obj_loader.h>

#include <cmath>
#include <istream>
#include <limits>
#include <unordered_map>
#include <utility>

#include "failure.h"
#include "text_lines.h"

namespace bake {
namespace {

/// Names to small numbers, in the order they come.
class Names {
 public:
  explicit Names(std::vector<std::string>& names) : names_(names) {}

  std::uint32_t id(const std::string& name) {
    const auto [entry, fresh] = ids_.try_emplace(name, static_cast<std::uint32_t>(names_.size()));
    if (fresh) {
      names_.push_back(name);
    }
    return entry->second;
  }

 private:
  std::vector<std::string>& names_;
  std::unordered_map<std::string, std::uint32_t> ids_;
};

/// What tinyobjloader calls back. It reads a number that it does not understand as 0 and knows no line numbers or
/// vertex colours; so vertex lines are read before it sees them, in on_line, and it splits the other statements.
class Reader {
 public:
  explicit Reader(const std::string& file)
      : file_(file),
        parts_(faces_.part_names),
        materials_(faces_.material_names),
        lines_(read_text(file), [this](std::string_view line, std::size_t) { return on_line(line); }) {}

  ObjFaces read() {
    tinyobj::callback_t calls;
    calls.index_cb = [](void* self, tinyobj::index_t* corners, int count) {
      static_cast<Reader*>(self)->on_face(corners, static_cast<std::size_t>(count));
    };
    calls.usemtl_cb = [](void* self, const char* name, int) {
      auto* reader = static_cast<Reader*>(self);
      reader->material_ = reader->materials_.id(name);
    };
    calls.group_cb = [](void* self, const char** names, int count) {
      static_cast<Reader*>(self)->on_group(names, count);
    };
    calls.object_cb = [](void* self, const char* name) {
      auto* reader = static_cast<Reader*>(self);
      reader->object_ = name;
      reader->group_.clear();
      reader->part_ = k_no_index;
    };
    std::istream stream(&lines_);
    stream.exceptions(std::ios::badbit);  // or the stream swallows what on_line throws
    tinyobj::LoadObjWithCallback(stream, calls, this);
    check_ranges();
    return std::move(faces_);
  }

 private:
  [[noreturn]] void fail(std::size_t line, const std::string& words) const {
    throw Failure(ExitCode::input, at_line(file_, line, words));
  }

  std::string_view on_line(std::string_view line) {
    if (line.starts_with('v')) {
      const std::vector<std::string_view> fields = split_fields(line);
      if (fields[0] == "v" || fields[0] == "vn" || fields[0] == "vt") {
        on_vertex_line(fields, line);
      }
    } else if (line.starts_with("mtllib ") || line.starts_with("mtllib\t")) {
      faces_.mtl_files.emplace_back(line.substr(line.find_first_not_of(" \t", 6)));
      faces_.mtl_lines.push_back(lines_.number());
    } else if (line == "g") {  // no name: the default group; tinyobjloader passes over it
      on_group(nullptr, 0);
    } else if (line.starts_with('f')) {
      return line.substr(0, line.find('#'));
    }
    return line;
  }

  void on_vertex_line(std::vector<std::string_view> fields, std::string_view line) {
    const std::string kind(fields[0]);
    fields.erase(fields.begin());
    for (std::size_t i = 0; i < fields.size(); ++i) {
      if (fields[i].starts_with('#')) {
        fields.resize(i);
      }
    }
    const std::size_t wanted = kind == "vt" ? 1 : 3;
    const auto numbers = parse_numbers(fields);
    if (!numbers || numbers->size() < wanted) {
      fail(lines_.number(), kind + " wants " + (wanted == 1 ? "a finite number" : "three finite numbers") + ", not \"" +
                                std::string(line) + "\"");
    }
    const std::vector<double>& n = *numbers;
    for (const double value : n) {
      if (std::abs(value) > std::numeric_limits<float>::max()) {
        fail(lines_.number(), "a number is too large: \"" + std::string(line) + "\"");
      }
    }
    if (kind == "v") {
      add_position(n);
    } else if (kind == "vn") {
      faces_.normals.emplace_back(n[0], n[1], n[2]);
    } else {
      faces_.uvs.emplace_back(n[0], n.size() > 1 ? n[1] : 0.0);
    }
  }

  /// x y z, x y z w (w is not used), x y z r g b as Meshlab and ZBrush write it, or x y z w r g b.
  void add_position(const std::vector<double>& n) {
    faces_.positions.emplace_back(n[0], n[1], n[2]);
    if (n.size() >= 6) {
      faces_.colors.resize(faces_.positions.size() - 1, glm::vec3(1));
      faces_.colors.emplace_back(n[n.size() - 3], n[n.size() - 2], n[n.size() - 1]);
    } else if (!faces_.colors.empty()) {
      faces_.colors.emplace_back(1);
    }
  }

  void on_group(const char** names, int count) {
    group_.clear();
    for (int i = 0; i < count; ++i) {
      group_.append(i > 0 ? " " : "").append(names[i]);
    }
    part_ = k_no_index;
  }

  /// As the file says it: from 1, or from the last one (-1) backwards; tinyobjloader gives 0 where there is none.
  std::uint32_t resolve(int index, std::size_t count, const char* what) const {
    if (index >= 0) {
      return index == 0 ? k_no_index : static_cast<std::uint32_t>(index) - 1;
    }
    const auto back = static_cast<std::size_t>(-static_cast<std::int64_t>(index));
    if (back > count) {
      fail(lines_.number(), std::string(what) + " index " + std::to_string(index) + " is out of range: there are " +
                                std::to_string(count) + " so far");
    }
    return static_cast<std::uint32_t>(count - back);
  }

  void on_face(const tinyobj::index_t* corners, std::size_t count) {
    if (part_ == k_no_index) {
      part_ = parts_.id(object_.empty() || group_.empty() ? object_ + group_ : object_ + "/" + group_);
    }
    faces_.faces.push_back(
        {faces_.corners.size(), static_cast<std::uint32_t>(count), part_, material_, lines_.number()});
    for (std::size_t i = 0; i < count; ++i) {
      const ObjCorner corner{resolve(corners[i].vertex_index, faces_.positions.size(), "vertex"),
                             resolve(corners[i].texcoord_index, faces_.uvs.size(), "texture vertex"),
                             resolve(corners[i].normal_index, faces_.normals.size(), "normal")};
      if (corner.position == k_no_index) {
        fail(lines_.number(), "a face corner has no vertex index");
      }
      faces_.corners.push_back(corner);
    }
  }

  void check_ranges() const {  // at the end: a face may name vertices that follow it
    const auto check = [this](const ObjFace& face, std::uint32_t index, std::size_t count, const char* what) {
      if (index != k_no_index && index >= count) {
        fail(face.line, std::string(what) + " index " + std::to_string(index + 1) + " is out of range: there are " +
                            std::to_string(count));
      }
    };
    for (const ObjFace& face : faces_.faces) {
      for (std::size_t i = face.first_corner; i < face.first_corner + face.corner_count; ++i) {
        check(face, faces_.corners[i].position, faces_.positions.size(), "vertex");
        check(face, faces_.corners[i].uv, faces_.uvs.size(), "texture vertex");
        check(face, faces_.corners[i].normal, faces_.normals.size(), "normal");
      }
    }
  }

  const std::string& file_;
  ObjFaces faces_;
  Names parts_;
  Names materials_;
  LineStream lines_;
  std::string object_;
  std::string group_;
  std::uint32_t part_ = k_no_index;
  std::uint32_t material_ = k_no_index;
};

}  // namespace

ObjFaces read_obj_faces(const std::string& file) {
  return Reader(file).read();
}

}  // namespace bake
