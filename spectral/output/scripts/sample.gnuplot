# Drawn directions as seen from above the surface, each lobe in a colour.
#   title    text
#   $draws   x, y of a direction and its lobe: 1 specular, 2 directional diffuse, 3 uniform diffuse; 4 is the
#            light
set title title noenhanced font ',17'
set size ratio -1
set xrange [-1.15:1.15]
set yrange [-1.15:1.15]
unset border
unset tics
unset grid
set key outside right top samplen 1
set for [s=1:3] object s circle at 0,0 size sin(30*s*pi/180) fc rgb '#999999' fs empty border rgb '#bbbbbb'
set for [s=1:3] label s sprintf('%d°', 30*s) at 0,-sin(30*s*pi/180)-0.03 center tc rgb '#777777' font ',12'
plot $draws using 1:($3==2 ? $2 : 1/0) with points pt 7 ps 0.25 lc rgb '#0072b2' notitle, \
     '' using 1:($3==3 ? $2 : 1/0) with points pt 7 ps 0.25 lc rgb '#009e73' notitle, \
     '' using 1:($3==1 ? $2 : 1/0) with points pt 7 ps 1 lc rgb '#d55e00' title 'specular', \
     NaN with points pt 7 lc rgb '#0072b2' title 'directional diffuse', \
     NaN with points pt 7 lc rgb '#009e73' title 'uniform diffuse', \
     '' using 1:($3==4 ? $2 : 1/0) with points pt 2 ps 1.5 lc rgb '#000000' title 'light'
