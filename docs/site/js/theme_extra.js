// The theme styles tables of this class only. Debian's package of mkdocs names a file for that in its pages, and leaves it out.
$("div.rst-content table").addClass("docutils");
