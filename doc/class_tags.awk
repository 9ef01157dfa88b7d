# SPDX-License-Identifier: LGPL-2.1-or-later
# Of deal.II's tag file, the classes, in the namespace where its headers put them: its
# own pages are made without that, and its members have names that mean other things here.
BEGIN { print "<?xml version='1.0' encoding='UTF-8'?>\n<tagfile>" }
/^  <compound kind="(class|struct)"/ { in_class = 1; opening = $0 }
/^    <name>/ && in_class {
  in_class = $0 !~ /&lt;|std::|boost::/
  sub(/<name>/, "<name>dealii::")
  if (in_class) print opening "\n" $0
}
/^    <filename>/ && in_class { print }
/^  <\/compound>/ && in_class { in_class = 0; print }
END { print "</tagfile>" }
