// What the daemon thinks of documents, for schema_test.py: reads lines "figure JSON", "scene JSON" or "tempus STATURE",
// and answers each with a line: "ok", the error, or the built-in figure's document.
#include <iostream>
#include <string>

#include "proto/codec.h"
#include "server/scene/scene.h"
#include "server/solver/tempus.h"

namespace {

using namespace posed;

std::string said(const Error& error) {
  return error.code + " " + error.path + ": " + error.message;
}

std::string check_figure_text(const std::string& text) {
  const Result<FigureDocument> figure = proto::decode_figure(text);
  if (!figure) return said(figure.error());
  const Result<BodyTree> tree = BodyTree::build(*figure);
  return tree ? "ok" : said(tree.error());
}

std::string check_scene_text(const std::string& text) {
  const Result<SceneDocument> document = proto::decode_scene(text);
  if (!document) return said(document.error());
  Scene scene;
  const Status loaded = scene.load(*document);
  return loaded ? "ok" : said(loaded.error());
}

}  // namespace

int main() {
  for (std::string line; std::getline(std::cin, line);) {
    const std::size_t space = line.find(' ');
    const std::string word = line.substr(0, space), text = line.substr(space + 1);
    if (word == "tempus")
      std::cout << proto::encode_figure(*tempus(std::stod(text))) << std::endl;
    else
      std::cout << (word == "figure" ? check_figure_text(text) : check_scene_text(text)) << std::endl;
  }
}
