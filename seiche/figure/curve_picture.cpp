#include <seiche/core/base/error.hpp>
#include <seiche/figure/curve_picture.hpp>
#include <seiche/figure/drawing.hpp>
#include <seiche/figure/drawing_folder.hpp>

#include <nlohmann/json.hpp>

namespace seiche {
namespace {

using Json = nlohmann::ordered_json;

Json json_of(const PictureAxis& axis) {
  return {{"label", axis.label},
          {"log", axis.logarithmic},
          {"powers_of_two", axis.powers_of_two},
          {"limits", axis.limits ? Json{axis.limits->first, axis.limits->second} : Json()}};
}

Json json_of(const Series& series) {
  return {{"label", series.label},
          {"x", series.x},
          {"y", series.y},
          {"colour", series.style.colour},
          {"marker", name_of(series.style.marker)},
          {"filled", series.style.filled},
          {"dash", name_of(series.style.dash)},
          {"width", series.style.width},
          {"layer", series.layer},
          {"marked", series.marked ? Json(*series.marked) : Json()}};
}

Json json_of(const CurvePicture& picture) {
  Json series = Json::array();
  for (const Series& one : picture.series) series.push_back(json_of(one));
  return {{"stem", picture.stem},    {"title", picture.title}, {"caption", picture.caption}, {"x", json_of(picture.x)},
          {"y", json_of(picture.y)}, {"series", series},       {"slope", picture.slope_two}};
}

}  // namespace

void draw_curves(std::vector<CurvePicture>& pictures, const std::filesystem::path& directory, const CurveFiles& files) {
  Json all = Json::array();
  for (const CurvePicture& picture : pictures) {
    const std::string& stem = picture.stem;
    if (stem.empty() || stem.find('/') != std::string::npos || stem.find('\n') != std::string::npos)
      throw Error("'{}' cannot be the name of a figure file", stem);
    all.push_back(json_of(picture));
  }
  DrawingFolder drawing(directory);
  const Json grounds = files.dark ? Json::array({"light", "dark"}) : Json::array({"light"});
  Json request = {{"pictures", all},
                  {"formats", files.formats},
                  {"grounds", grounds},
                  {"journal", files.journal},
                  {"warning", files.warning}};
  if (files.width > 0) request["width"] = files.width;
  const Json drawn = Json::parse(draw(request.dump(), drawing.path()));
  for (std::size_t i = 0; i < pictures.size(); ++i) pictures[i].caption = drawn.at("pictures").at(i).at("caption");
  if (files.when_drawn) files.when_drawn();
  drawing.commit();
}

}  // namespace seiche
