// Reads a 3MF file with the 3MF consortium's library and prints a line for each object, "vertices triangles manifold";
// the last is 1 if the library calls the object manifold and oriented. Exit code 1 on an error of the library, 2 on
// warnings.
#include <Model/COM/NMR_DLLInterfaces.h>

#include <cstdio>
#include <cstdlib>

namespace {

void check(LIB3MFRESULT result, const char* what) {
  if (result == LIB3MF_OK) return;
  std::fprintf(stderr, "lib3mf: %s: %08x\n", what, static_cast<unsigned>(result));
  std::exit(1);
}

}  // namespace

int main(int count, char** words) {
  using namespace NMR;
  if (count != 2) return 1;
  PLib3MFModel* model = nullptr;
  PLib3MFModelReader* reader = nullptr;
  PLib3MFModelResourceIterator* objects = nullptr;
  check(lib3mf_createmodel(&model), "create a model");
  check(lib3mf_model_queryreader(model, "3mf", &reader), "make a reader");
  check(lib3mf_reader_readfromfileutf8(reader, words[1]), "read");
  DWORD warnings = 0;
  check(lib3mf_reader_getwarningcount(reader, &warnings), "count warnings");
  check(lib3mf_model_getmeshobjects(model, &objects), "list objects");
  for (BOOL has_next = 0;;) {
    check(lib3mf_resourceiterator_movenext(objects, &has_next), "go on");
    if (!has_next) break;
    PLib3MFModelResource* object = nullptr;
    check(lib3mf_resourceiterator_getcurrent(objects, &object), "take an object");
    DWORD vertices = 0, triangles = 0;
    BOOL is_manifold = 0;
    check(lib3mf_meshobject_getvertexcount(object, &vertices), "count vertices");
    check(lib3mf_meshobject_gettrianglecount(object, &triangles), "count triangles");
    check(lib3mf_meshobject_ismanifoldandoriented(object, &is_manifold), "judge");
    std::printf("%u %u %d\n", static_cast<unsigned>(vertices), static_cast<unsigned>(triangles), is_manifold ? 1 : 0);
  }
  if (warnings > 0) std::fprintf(stderr, "lib3mf: %u warnings\n", static_cast<unsigned>(warnings));
  return warnings > 0 ? 2 : 0;
}
