#!/usr/bin/env perl
# SPDX-License-Identifier: LGPL-2.1-or-later
# Turns commented C++ files into one Doxygen page on which prose and code take
# turns: lines that are only a "//" comment become prose, with their Markdown
# and formulas; all others become code. "// @sect3{Title}" makes a heading,
# @sect1 being the highest. Doxygen comments (///) stay with the code.
#   commented_program.pl <file>... > page.md
use strict;
use warnings;

my ($n_sections, @code) = (0);

# Print the code collected so far, without empty lines at its ends.
sub flush_code
{
  shift @code while @code && $code[0]  =~ /^\s*$/;
  pop   @code while @code && $code[-1] =~ /^\s*$/;
  print "\n\@code{.cpp}\n", (map { "$_\n" } @code), "\@endcode\n\n" if @code;
  @code = ();
}

print "# The commented program {#commented_program}\n\n[TOC]\n\n";

for my $file (@ARGV)
  {
    open(my $input, '<', $file) or die "cannot read $file: $!\n";
    (my $name = $file) =~ s{.*/(?=[^/]+/[^/]+$)}{};
    print "\n## $name {#program_section_", ++$n_sections, "}\n\n";
    while (my $line = <$input>)
      {
        chomp $line;
        next if $line =~ /SPDX-License-Identifier/;
        if ($line =~ m{^\s*//\s*[\@\\]sect(\d)\{(.*)\}\s*$})
          {
            flush_code();
            my $level = $1 < 3 ? 3 : $1 > 5 ? 5 : $1;
            print "\n", '#' x $level, " $2 {#program_section_",
              ++$n_sections, "}\n\n";
          }
        # "// clang-format off" is no prose.
        elsif ($line =~ m{^\s*//(?!/)(?!\s*clang-format) ?(.*)$})
          {
            flush_code();
            print "$1\n";
          }
        else
          {
            push @code, $line;
          }
      }
    flush_code();
  }
