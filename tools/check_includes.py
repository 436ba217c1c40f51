#!/usr/bin/env python3
"""Checks in a second that each source includes what it uses. Unity builds hide missing includes: a source sees the
headers of its neighbours until the batches change.

usage: tools/check_includes.py [FILE...]     by default all sources of src, apps and bindings/c

Each source must reach the needed headers by its own includes. A name of the standard library needs one of the headers
that declare it (STANDARD, as generous as libstdc++). A type, function, constant or macro of Scarp needs its header.
Names in several headers are left to the compiler. `tests/packaging/test_each_source.sh` compiles each source alone.
"""
import collections
import functools
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
FOLDERS = ["src", "apps", "bindings/c", "include"]
SEARCHED = ["include", "src", "apps/scarp", "bindings/c"]

STANDARD = {
    "algorithm": "all_of any_of binary_search clamp copy copy_n count count_if equal equal_range fill fill_n find find_if "
    "find_if_not for_each includes inplace_merge is_sorted lexicographical_compare lower_bound max_element merge min_element "
    "minmax minmax_element next_permutation none_of nth_element partial_sort partition remove remove_if replace reverse "
    "rotate search set_difference set_intersection set_union sort stable_partition stable_sort swap_ranges transform unique "
    "upper_bound",
    "array": "array to_array",
    "atomic": "atomic atomic_ref memory_order_acquire memory_order_relaxed memory_order_release",
    "bit": "bit_cast bit_ceil bit_floor bit_width countl_zero countr_zero endian has_single_bit popcount",
    "bitset": "bitset",
    "charconv": "from_chars to_chars",
    "chrono": "chrono",
    "cmath": "acos asin atan atan2 cbrt ceil copysign cos cosh exp fabs floor fma fmod frexp hypot isfinite isinf isnan ldexp "
    "llround log log10 log1p log2 lround nearbyint nextafter pow remainder rint round signbit sin sinh sqrt tan tanh trunc",
    "condition_variable": "condition_variable condition_variable_any",
    "cstring": "memchr memcmp memcpy memmove memset strcmp strerror strlen",
    "deque": "deque",
    "exception": "current_exception exception_ptr rethrow_exception",
    "filesystem": "filesystem",
    "fstream": "fstream ifstream ofstream",
    "functional": "function greater hash less multiplies plus",
    "iostream": "cerr cin cout",
    "list": "list",
    "map": "map multimap",
    "mutex": "call_once lock_guard mutex once_flag recursive_mutex scoped_lock unique_lock",
    "numbers": "numbers",
    "numeric": "accumulate gcd inner_product iota lcm partial_sum reduce",
    "queue": "priority_queue queue",
    "random": "mt19937 mt19937_64 normal_distribution uniform_int_distribution uniform_real_distribution",
    "set": "multiset set",
    "shared_mutex": "shared_lock shared_mutex",
    "sstream": "istringstream ostringstream stringstream",
    "span": "dynamic_extent span",
    "stack": "stack",
    "thread": "this_thread thread",
    "tuple": "apply forward_as_tuple make_tuple tie tuple",
    "type_traits": "conditional_t decay_t enable_if_t is_same_v is_trivially_copyable_v remove_cvref_t underlying_type_t",
    "unordered_map": "unordered_map",
    "unordered_set": "unordered_set",
    "variant": "get_if holds_alternative monostate variant visit",
    "vector": "vector",
    "optional": "nullopt optional",
    "memory": "make_shared make_unique shared_ptr unique_ptr weak_ptr",
}
# Headers with others that they include in libstdc++, or that Scarp may rely on.
BRINGS = {
    "algorithm": "functional numeric".split(),
    "sstream": ["string", "iostream"],
    "iostream": ["string"],
    "fstream": ["filesystem"],
    "mutex": ["shared_mutex", "condition_variable"],
    "vector": ["queue", "stack"],
    "deque": ["queue", "stack"],
    "functional": "string unordered_map map set random memory optional string_view variant thread".split(),
    "tuple": "functional map memory mutex unordered_map".split(),
    "memory": ["functional"],
    "array": "functional tuple span string unordered_map map string_view ranges".split(),
    "type_traits": None,
    "exception": None,
    "bit": None,
}
NEEDED = {name: {header, *(BRINGS.get(header) or [])} for header, names in STANDARD.items() for name in names.split()
          if not (header in BRINGS and BRINGS[header] is None)}


# Names without std::, and those that Scarp uses from other libraries.
OTHERS = {r"\bassert\(": "cassert", r"\bfmt::": "fmt/format.h", r"\bnlohmann::": "nlohmann/json.hpp"}
OTHER_HOMES = {"fmt/format.h": ["fmt/core.h", "fmt/chrono.h"], "nlohmann/json.hpp": ["nlohmann/json_fwd.hpp"]}


def is_constant(name):
    return re.fullmatch(r"k[A-Z]\w*", name) is not None


@functools.cache
def code_of(path):
    """The file without comments and literals, and the files that it includes."""
    text = path.read_text(encoding="utf-8")
    included = re.findall(r'^\s*#\s*include\s+(?:"([^"]+)"|<([^>]+)>)', text, re.M)
    text = re.sub(r"^\s*#\s*include.*$", "", text, flags=re.M)
    text = re.sub(r'R"(\w*)\(.*?\)\1"', '""', text, flags=re.S)
    text = re.sub(r'//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])+\'', " ", text, flags=re.S)
    return text, included


@functools.cache
def find_header(name, folder):
    for start in [folder, *(ROOT / place for place in SEARCHED)]:
        if (start / name).is_file():
            return (start / name).resolve()
    return None


@functools.cache
def reached(path):
    """The headers of Scarp, and the names of others, that the file includes directly or indirectly."""
    own, others, todo = {path}, set(), [path]
    while todo:
        file = todo.pop()
        for quoted, angled in code_of(file)[1]:
            header = find_header(quoted or angled, file.parent)
            if header is None:
                others.add(quoted or angled)
            elif header not in own:
                own.add(header)
                todo.append(header)
    return own, others


@functools.cache
def declared(path):
    """The names that a header declares in a namespace, whose contents are not indented."""
    text = code_of(path)[0]
    names = set(re.findall(r"^(?:template\s*<.*>\s*)?(?:class|struct|enum class|enum)\s+(?:\[\[\w+\]\]\s*)?(\w+)[^;]*?\{", text, re.M))
    names |= set(re.findall(r"^using (\w+) =", text, re.M))
    names |= set(re.findall(r"^#define (\w+)", text, re.M))
    names |= set(re.findall(r"^(?:inline |static |extern )*(?:constexpr |const )+[\w:<>, ]+? (k[A-Z]\w*)", text, re.M))
    names |= set(re.findall(r"^(?!return|using|namespace|#|class|struct|enum|friend|typedef|static_assert)[\w\[][\w:<>,&*\[\] ]*? [&*]?([a-z]\w*)\(", text, re.M))
    return {name for name in names if len(name) > 3}


@functools.cache
def nested(path):
    """The types, constants and template parameters that the file declares anywhere."""
    text = code_of(path)[0]
    names = set(re.findall(r"\b(?:class|struct|enum class|enum|typename|using)\s+(\w+)\b(?!::)", text))
    return names | set(re.findall(r"\b(k[A-Z]\w*)\s*(?:=|,|\}|\[\w*\]\s*=|\{)", text))


@functools.cache
def members(path):
    """Names declared with indentation, in a class, a function or parameters, and those that the file declares."""
    text = code_of(path)[0]
    return set(re.findall(r"[\w>&*\]] [&*]?(\w+)\s*[({;=,)\[]", text))


# A name, after any namespaces of Scarp.
NAME = re.compile(r"(?<![\w.>:])(?!(?:std|fmt|hn|hwy|nlohmann)::)(?:[a-z]+::)*([A-Z]\w*\b|[a-z_]\w*\b(?!::))")


def main():
    headers = [path for folder in FOLDERS for path in sorted((ROOT / folder).rglob("*.h"))]
    homes = collections.defaultdict(set)
    for header in headers:
        for name in declared(header):
            homes[name].add(header.resolve())
    # Headers that a batch can hide: those reached by a source of the same folder.
    near = collections.defaultdict(set)
    for folder in FOLDERS:
        for path in (ROOT / folder).rglob("*.cpp"):
            near[path.resolve().parent] |= reached(path.resolve())[0]
    files = [pathlib.Path(name).resolve() for name in sys.argv[1:]] or [
        path.resolve() for folder in FOLDERS for path in sorted((ROOT / folder).rglob("*.cpp"))]
    faults = 0
    for path in files:
        text = code_of(path)[0]
        own, others = reached(path)
        for name in sorted(set(re.findall(r"\bstd::(\w+)", text))):
            if name in NEEDED and not NEEDED[name] & others:
                print(f"{path.relative_to(ROOT)}: std::{name} needs <{sorted(NEEDED[name])[0]}>")
                faults += 1
        for pattern, header in OTHERS.items():
            if re.search(pattern, text) and not others & {header, *OTHER_HOMES.get(header, [])}:
                print(f"{path.relative_to(ROOT)}: {pattern} needs <{header}>")
                faults += 1
        for name in sorted(set(NAME.findall(text)) & homes.keys()):
            home = homes[name]
            if len(home) == 1 and home <= near[path.parent] - own and not any(
                    name in (members if name[0].islower() and not is_constant(name) else nested)(file) for file in own):
                print(f"{path.relative_to(ROOT)}: {name} needs {next(iter(home)).relative_to(ROOT)}")
                faults += 1
    print(f"{len(files)} sources, {faults} missing includes")
    return 1 if faults else 0


sys.exit(main())
