#include <set>
#include <vector>

#include "server/solver/figure_check_parts.h"

namespace posed::figure_check {
namespace {

std::string pointer_token(const std::string& name) {
  std::string token;
  for (const char c : name.substr(0, 130)) token += c == '~' ? "~0" : c == '/' ? "~1" : std::string(1, c);
  return token;
}

// Each names segments.
class References {
 public:
  References(const FigureDocument& document, const Index& all) : d_(document), all_(all) {}

  Maybe check() const {
    if (d_.sites.size() > kMaxNames) return bad("/sites", "there are more than 2000 sites", "leave some out");
    if (d_.aliases.size() > kMaxNames) return bad("/aliases", "there are more than 2000 aliases", "leave some out");
    if (auto e = check_sites()) return e;
    if (auto e = check_mirror()) return e;
    return check_aliases();
  }

 private:
  Maybe known(const std::string& path, const std::string& name) const {
    if (all_.count(name)) return {};
    std::vector<std::string> names;
    for (const Segment& s : d_.segments) names.push_back(s.name);
    return bad(path, "no segment is called " + name.substr(0, 64), did_you_mean(name, names));
  }

  Maybe check_sites() const {
    for (const auto& [name, site] : d_.sites) {
      const std::string path = std::string("/sites/") + pointer_token(name);
      if (auto e = known(path + "/segment", site.segment)) return e;
      const auto slash = name.find('/');
      if (auto e = check_name(path, "a site of segment " + site.segment,
                              slash == std::string::npos ? name : name.substr(slash + 1)))
        return e;
      if (slash != std::string::npos && name.substr(0, slash) != site.segment) {
        return bad(path, "site " + name + " is not named after its segment " + site.segment,
                   "call it " + site.segment + name.substr(slash));
      }
      if (auto e = check_point(path + "/point", "site " + name, site.point)) return e;
    }
    return {};
  }

  Maybe check_mirror() const {
    std::set<std::string> seen;
    for (std::size_t i = 0; i < d_.mirror.size(); ++i) {
      const std::string path = at("/mirror", i);
      const auto& [left, right] = d_.mirror[i];
      if (auto e = known(path + "/0", left)) return e;
      if (auto e = known(path + "/1", right)) return e;
      if (!seen.insert(left).second || !seen.insert(right).second) {
        std::string pair = left;
        pair.append(", ").append(right);
        return bad(path, "a segment of the pair " + pair + " is mirrored twice",
                   "name each segment in one pair; what stands in none mirrors itself");
      }
    }
    return {};
  }

  Maybe check_aliases() const {
    for (const auto& [alias, name] : d_.aliases) {
      const std::string path = std::string("/aliases/") + pointer_token(alias);
      if (auto e = check_name(path, "an alias of segment " + name.substr(0, 64), alias)) return e;
      if (auto e = known(path, name)) return e;
      if (alias != name && all_.count(alias)) {
        return bad(path, "the alias " + alias + " is the name of another segment", "choose another alias");
      }
    }
    return {};
  }

  const FigureDocument& d_;
  const Index& all_;
};

}  // namespace

Maybe check_references(const FigureDocument& document, const Index& all) {
  return References(document, all).check();
}

}  // namespace posed::figure_check
