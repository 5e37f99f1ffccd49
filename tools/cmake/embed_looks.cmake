# Writes OUT, a C++ file with the texts of FILES (looks) as a table.
set(rows "")
foreach(file ${FILES})
  get_filename_component(name ${file} NAME_WE)
  file(READ ${file} text)
  string(APPEND rows "      {\"${name}\", R\"LOOK(${text})LOOK\"},\n")
endforeach()
file(WRITE ${OUT} "#include \"look/shipped_looks.h\"

namespace scumble::look {

const std::vector<ShippedLookFile>& shippedLookFiles() {
  static const std::vector<ShippedLookFile> files{
${rows}  };
  return files;
}

}  // namespace scumble::look
")
