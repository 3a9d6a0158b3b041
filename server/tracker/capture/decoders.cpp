#include "server/tracker/capture/decoders.h"

#include <charconv>
#include <utility>
#include <vector>

#include "common/names.h"
#include "server/tracker/fastrak/decoder.h"
#include "server/tracker/isotrak/decoder.h"
#include "server/tracker/liberty/decoder.h"
#include "server/tracker/spacemouse/decoder.h"
#include "server/tracker/viper/decoder.h"

namespace posed::tracker {
namespace {

using Words = std::vector<std::string_view>;

Words split(std::string_view text, char separator) {
  Words words;
  while (!text.empty()) {
    const std::size_t end = text.find(separator);
    if (end != 0) words.push_back(text.substr(0, end));
    text = end == std::string_view::npos ? std::string_view{} : text.substr(end + 1);
  }
  return words;
}

// 0: it is none.
int number(std::string_view text) {
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc{} && end == text.data() + text.size() ? value : -1;
}

bool items_of(std::string_view text, std::vector<int>& items) {
  items.clear();
  for (const std::string_view word : split(text, ',')) items.push_back(number(word));
  return !items.empty();
}

bool unit_of(std::string_view word, double& metres_per_unit) {
  metres_per_unit = word == "in" ? kMetresPerInch : kMetresPerCentimetre;
  return word == "in" || word == "cm";
}

template <class D>
std::unique_ptr<Decoder> own(Result<D> made) {
  return made ? std::make_unique<D>(std::move(*made)) : nullptr;
}

// Each takes the words after the device.
std::unique_ptr<Decoder> liberty(std::string device, const Words& words) {
  LibertyFormat format;
  format.device = std::move(device);
  if (words.size() != 5 || words[0].size() != 2 || !items_of(words[2], format.items)) return nullptr;
  format.tag = {words[0][0], words[0][1]};
  format.stations = number(words[1]);
  format.rate_hz = number(words[4]);
  if (!unit_of(words[3], format.metres_per_unit)) return nullptr;
  if (format.stations < 1 || format.stations > 16 || format.rate_hz < 1) return nullptr;
  return own(LibertyDecoder::make(std::move(format)));
}

std::unique_ptr<Decoder> fastrak(std::string device, const Words& words) {
  FastrakFormat format;
  format.device = std::move(device);
  if (words.size() != 4 || !items_of(words[1], format.items)) return nullptr;
  format.stations = number(words[0]);
  format.binary = words[2] == "binary";
  if (!format.binary && words[2] != "ascii") return nullptr;
  if (!unit_of(words[3], format.metres_per_unit) || format.stations < 1 || format.stations > 4) return nullptr;
  return own(FastrakDecoder::make(std::move(format)));
}

std::unique_ptr<Decoder> isotrak(std::string device, const Words& words) {
  if (words.size() != 1 || number(words[0]) < 1 || number(words[0]) > 2) return nullptr;
  return std::make_unique<IsotrakDecoder>(IsotrakFormat{std::move(device), number(words[0])});
}

std::unique_ptr<Decoder> viper(std::string device, const Words& words) {
  if (words.size() != 1 || number(words[0]) < 1) return nullptr;
  return std::make_unique<ViperDecoder>(ViperFormat{std::move(device), number(words[0])});
}

std::unique_ptr<Decoder> spacemouse(std::string device, const Words& words) {
  if (!words.empty()) return nullptr;
  SpacemouseFormat format;
  format.device = std::move(device);
  return std::make_unique<SpacemouseDecoder>(std::move(format));
}

struct Family {
  std::string_view name;
  std::unique_ptr<Decoder> (*make)(std::string device, const Words& words);
};

constexpr Family kFamilies[] = {
    {"liberty", liberty}, {"fastrak", fastrak}, {"isotrak", isotrak}, {"viper", viper}, {"spacemouse", spacemouse},
};

}  // namespace

Result<DescribedDecoder> make_decoder(std::string_view description) {
  Words words = split(description, ' ');
  if (words.size() >= 2 && valid_id(words[1])) {
    for (const Family& family : kFamilies) {
      if (family.name != words[0]) continue;
      const std::string device(words[1]);
      auto decoder = family.make(device, Words(words.begin() + 2, words.end()));
      if (decoder) return DescribedDecoder{std::move(decoder), device};
    }
  }
  return Error{"invalid_params", "no decoder is described by \"" + std::string(description.substr(0, 100)) + "\"", "",
               "as in: liberty liberty LY 16 8,9,11,3,7 cm 240"};
}

}  // namespace posed::tracker
