#!/usr/bin/env python3
"""The link lists are the architecture: holds every #include and every CMakeLists.txt against the table of ARCHITECTURE.md.

    python3 tests/layering_test.py [--self-test]

- A file includes only rooms and libraries that its room may use, and that its room links.
- A CMakeLists.txt links only what its room may use.
- What a room links PRIVATE stays inside: no header of it brings that library to another room.
"""

import re
import sys
from dataclasses import dataclass
from pathlib import Path

sys.dont_write_bytecode = True
sys.path.insert(0, str(Path(__file__).resolve().parent / "house"))
import tree  # noqa: E402


@dataclass
class Room:
    folder: str
    rooms: set  # that it may include and link
    libraries: set
    never: set  # headers that the folder's purpose excludes, of the standard library or of common


THREADS = {"thread", "mutex", "shared_mutex", "atomic", "condition_variable", "future", "semaphore", "stop_token", "pthread.h"}
FILES = {"fstream", "filesystem", "iostream", "unistd.h", "fcntl.h"}
CLOCK = {"chrono", "ctime", "time.h"}
SERVER = {"solver", "scene", "calibration", "tracker", "store", "net"}

# The table of ARCHITECTURE.md. GLM comes with common, to all.
ROOMS = {
    "common": Room("common", set(), set(), set()),
    "proto": Room("proto", {"common"}, {"nlohmann"}, THREADS | FILES),
    "solver": Room("server/solver", {"common"}, {"highway", "eigen"}, THREADS | FILES | CLOCK | {"common/log.h"}),
    "scene": Room("server/scene", {"common", "solver"}, set(), THREADS | FILES),
    "calibration": Room("server/calibration", {"common"}, set(), THREADS | FILES | CLOCK),
    "tracker": Room("server/tracker", {"common"}, {"asio", "libusb"}, set()),
    "store": Room("server/store", {"common", "scene", "solver", "proto"}, {"sqlite"}, set()),
    "net": Room("server/net", {"common", "proto"}, {"asio", "openssl"}, set()),
    "daemon": Room("server/daemon", {"common", "proto"} | SERVER, {"asio", "cli11"}, set()),
    "client": Room("client/lib", {"common", "proto"}, {"asio", "openssl"}, set()),
    "view": Room("client/cli/view", {"common", "proto", "client"}, set(), set()),  # before cli, in whose folder it lies
    "cli": Room("client/cli", {"common", "proto", "client", "view"}, {"asio", "openssl", "cli11"}, set()),
}

# how a library is included, and how it is linked
LIBRARIES = {
    "glm": (r"glm/", r"glm::.*"),
    "nlohmann": (r"nlohmann/", r"nlohmann_json::.*"),
    "asio": (r"boost/", r"Boost::.*"),
    "libusb": (r"(libusb-1\.0/)?libusb\.h", r"PkgConfig::LIBUSB"),
    "sqlite": (r"sqlite3\.h", r"PkgConfig::SQLITE"),
    "openssl": (r"openssl/", r"OpenSSL::.*"),
    "cli11": (r"CLI/", r"CLI11::.*"),
    "highway": (r"hwy/", r"PkgConfig::HWY"),
    "eigen": (r"Eigen/", r"Eigen3::.*"),
}
EVERYWHERE = {"glm"}
NO_LIBRARY = re.compile(r"[a-z0-9_]+(\.h)?$|(sys|linux|netinet|arpa|net)/")

INCLUDE = re.compile(r'^[ \t]*#[ \t]*include[ \t]*([<"])([^>"]+)[>"]', re.MULTILINE)
LINKS = re.compile(r"\b(?:posed_library|posed_program|target_link_libraries)\s*\(\s*(\w+)([^)]*)\)")


def room_of(path):
    for name, room in ROOMS.items():
        if path.startswith(room.folder + "/"):
            return name
    return None


def library_of(header):
    return next((name for name, (included, _) in LIBRARIES.items() if re.match(included, header)), None)


class Links:
    """What the CMakeLists.txt of one room link."""

    def __init__(self):
        self.public = set()
        self.private = set()

    def all(self):
        return self.public | self.private


def read_links(top, found):
    links = {name: Links() for name in ROOMS}
    for path in tree.files(top, ".txt"):
        room = room_of(str(path))
        if room is None or path.name != "CMakeLists.txt":
            continue
        content = re.sub(r"#.*", "", tree.text(top / path))
        for target, words in LINKS.findall(content):
            into = links[room].private
            for word in words.split():
                if word in ("PUBLIC", "INTERFACE", "PRIVATE"):
                    into = links[room].private if word == "PRIVATE" else links[room].public
                    continue
                name = next((name for name, (_, linked) in LIBRARIES.items() if re.fullmatch(linked, word)), None)
                if word.startswith("posed_") and word != "posed_flags":
                    name = word[len("posed_"):]
                    if name != room and name not in ROOMS[room].rooms:
                        found.append(f"{path}: {target} links {word}, which {room} must never see")
                elif name and name not in ROOMS[room].libraries | EVERYWHERE:
                    found.append(f"{path}: {target} links {word}, which {room} must never see")
                elif not name and not re.match(r"Threads::|posed_flags|\$", word):
                    found.append(f"{path}: {target} links {word}, which the table does not know")
                if name and name != room:
                    into.add(name)
    return links


def reachable(links, room):
    """What a room may include by its link lists: its own, and what those pass on."""
    seen, todo = set(), sorted(links[room].all())
    while todo:
        name = todo.pop()
        if name not in seen:
            seen.add(name)
            todo += sorted(links[name].public) if name in links else []
    return seen


def complaints(top):
    found = []
    links = read_links(top, found)
    includes = {}
    for path in tree.files(top, ".h", ".cpp"):
        includes[str(path)] = INCLUDE.findall(tree.text(top / path) or "")

    for path, lines in includes.items():
        room = room_of(path)
        if room is None:
            continue
        may, linked = ROOMS[room], reachable(links, room)
        for quote, header in lines:
            other, library = room_of(header), library_of(header)
            if header in may.never:
                found.append(f"{path}: includes {header}, which has no place in {room}")
            if quote == '"':
                if header not in includes:
                    found.append(f'{path}: includes "{header}", which is no path from the top of the tree')
                elif other is None:
                    found.append(f"{path}: includes {header}, which is in no room")
                elif other != room and other not in may.rooms:
                    found.append(f"{path}: includes {header}, and {room} must never see {other}")
                elif other != room and other not in linked:
                    found.append(f"{path}: includes {header}, and {room} does not link posed_{other}")
            elif library and library not in EVERYWHERE:
                if library not in may.libraries:
                    found.append(f"{path}: includes <{header}>, and {room} must never see {library}")
                elif library not in linked:
                    found.append(f"{path}: includes <{header}>, and {room} does not link {library}")
            elif not library and not NO_LIBRARY.match(header):
                found.append(f"{path}: includes <{header}>, a library that the table does not know")
    found += leaks(includes, links)
    return found


def leaks(includes, links):
    """Headers that bring a library which their room links PRIVATE to a file of another room."""
    found = set()

    def follow(path, home, chain, seen):
        for quote, header in includes[path]:
            library, there = library_of(header), room_of(path)
            if quote == "<" and library in links[there].private and there != home and library not in links[there].public:
                found.add(f"{chain[0]}: gets {library} of {there} through {' > '.join(chain[1:])}")
            elif quote == '"' and header in includes and room_of(header) and header not in seen:
                seen.add(header)
                follow(header, home, chain + [header], seen)

    for path in includes:
        if room_of(path):
            follow(path, room_of(path), [path], {path})
    return sorted(found)


SOUND = {
    "common/CMakeLists.txt": "posed_library(common)\n",
    "common/a.h": "#include <vector>\n#include <glm/vec3.hpp>\n",
    "common/log.h": "",
    "proto/CMakeLists.txt": "posed_library(proto PUBLIC posed_common PRIVATE nlohmann_json::nlohmann_json)\n",
    "proto/codec.h": '#include "common/a.h"\n',
    "proto/read.h": "#include <nlohmann/json.hpp>\n",
    "proto/codec.cpp": '#include "proto/read.h"\n',
    "server/solver/CMakeLists.txt": "posed_library(solver PUBLIC posed_common)\n",
    "server/solver/s.h": '#include "common/a.h"\n',
    "server/tracker/CMakeLists.txt": "posed_library(tracker PUBLIC posed_common PRIVATE Boost::headers PkgConfig::LIBUSB Threads::Threads)\n",
    "server/tracker/tracker.h": '#include "common/a.h"\n#include <sys/types.h>\n',
    "server/tracker/usb.h": "#include <libusb.h>\n",
    "server/tracker/usb.cpp": '#include "server/tracker/usb.h"\n#include <boost/asio.hpp>\n',
    "server/daemon/CMakeLists.txt": "posed_program(posed posed_tracker posed_proto CLI11::CLI11)\n",
    "server/daemon/main.cpp": '#include "server/tracker/tracker.h"\n#include "proto/codec.h"\n#include <CLI/CLI.hpp>\n',
    "client/lib/CMakeLists.txt": "posed_library(client PUBLIC posed_common posed_proto)\n",
    "tests/server/tracker/usb_test.cpp": '#include "server/tracker/usb.h"\n#include <gtest/gtest.h>\n',
}
FAULTS = [
    ({"server/solver/x.cpp": '#include "proto/codec.h"\n'}, "solver must never see proto"),
    ({"server/solver/x.cpp": "#include <thread>\n"}, "has no place in solver"),
    ({"server/solver/x.cpp": '  #  include "common/log.h"\n'}, "has no place in solver"),
    ({"server/solver/x.cpp": "#include <nlohmann/json.hpp>\n"}, "solver must never see nlohmann"),
    ({"server/solver/x.cpp": '#include "s.h"\n'}, "no path from the top"),
    ({"server/solver/CMakeLists.txt": "posed_library(solver PUBLIC posed_common posed_scene)\n"}, "solver must never see"),
    ({"server/tracker/tracker.h": '#include "server/tracker/usb.h"\n'}, "main.cpp: gets libusb of tracker"),
    ({"proto/codec.h": '#include "proto/read.h"\n'}, "main.cpp: gets nlohmann of proto"),
    ({"client/lib/c.cpp": '#include "server/tracker/tracker.h"\n'}, "client must never see tracker"),
    ({"client/lib/c.cpp": "#include <boost/asio.hpp>\n"}, "client does not link asio"),
    ({"server/daemon/x.cpp": '#include "server/solver/s.h"\n'}, "daemon does not link posed_solver"),
    ({"server/daemon/x.cpp": '#include "tests/support/x.h"\n', "tests/support/x.h": ""}, "in no room"),
    ({"common/x.cpp": "#include <fmt/format.h>\n"}, "a library that the table does not know"),
    ({"common/CMakeLists.txt": "posed_library(common PUBLIC fmt::fmt)\n"}, "which the table does not know"),
]

if __name__ == "__main__":
    tree.main(complaints, SOUND, FAULTS)
