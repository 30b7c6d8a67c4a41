# Writes text files into a C++ source that finds them by name: troubleshootingPage() of
# hil/record/troubleshooting_pages.hpp. Run at build time: cmake -DOUTPUT=... -DFOLDER=... -P
file(GLOB pages ${FOLDER}/bench-*.md)
set(source "#include \"hil/record/troubleshooting_pages.hpp\"\n\nnamespace ballbot {\n\nconst char* troubleshootingPage(const std::string& name) {\n")
foreach(page ${pages})
  get_filename_component(name ${page} NAME)
  file(READ ${page} text)
  string(APPEND source "  if (name == \"${name}\") return R\"page(${text})page\";\n")
endforeach()
string(APPEND source "  return nullptr;\n}\n\n}  // namespace ballbot\n")
file(WRITE ${OUTPUT} "${source}")
