#!/usr/bin/env python3
"""Writes spectra.json: what the kinds of surface, cloud, ring and light look like from 300 to 2500 nm.

    spectra.py JHU OUT.json

JHU  the folder Data/Input/BD-CNES/JHU/becknic of Debian's source package otb 8.1.1+dfsg: spectra of the Johns Hopkins
     University, part of the ASTER spectral library.

The other measured numbers stand below, each with its paper. Needs python3-numpy.
"""
import json
import sys

import numpy as np

BASE = np.array([*range(300, 1100, 10), *range(1100, 2501, 20)], float)


def columns(text):
    v = np.array(text.split(), float)
    return v[0::2], v[1::2]


# Karkoschka 1998: wavelength, Jupiter, Saturn, Uranus, Neptune. Points picked from the 0.4 nm table so that straight
# lines between them follow the methane bands; a few in the violet are means over 4 nm, where Raman scattering mixes
# the Sun's lines.
GIANTS = np.array("""
302 .2281 .2363 .5250 .5592  310 .2720 .2360 .5281 .5850  320 .2737 .2243 .5232 .5712  330 .2821 .2148 .5182 .5671
340 .2933 .2059 .5142 .5615  350 .3070 .2009 .5176 .5665  360 .3160 .1954 .5114 .5606  370 .3283 .1957 .5164 .5656
380 .3462 .2026 .5377 .5863  390 .3605 .2113 .5416 .5840  400 .3741 .2255 .5329 .5691  410 .3940 .2473 .5560 .5890
420 .4137 .2743 .5663 .5821  430 .4260 .2980 .5890 .6020  440 .4375 .3207 .5560 .5520  450 .4534 .3466 .5889 .5902
460 .4619 .3639 .5519 .5295  470 .4755 .3830 .6140 .5958  480 .4863 .3986 .5717 .5350  485.2 .4837 .4006 .4411 .3890
490 .4966 .4146 .6220 .5887  500 .5050 .4278 .6224 .5828  505.2 .5069 .4329 .5876 .5337  510 .5085 .4366 .5162 .4538
514.8 .5172 .4470 .6366 .5840  520 .5193 .4531 .5931 .5355  530 .5233 .4623 .6127 .5529  535.2 .5261 .4681 .5140 .4439
540 .5184 .4648 .3740 .3044  543.2 .5061 .4525 .2916 .2365  547.2 .5331 .4848 .5140 .4461  550 .5277 .4871 .6169 .5522
560 .5460 .5042 .5987 .5277  570 .5431 .5118 .4866 .4018  576 .5403 .5104 .3847 .3014  580 .5470 .5221 .4616 .3766
585.2 .5494 .5326 .5870 .5067  590 .5485 .5391 .5575 .4736  596 .5422 .5344 .4053 .3148  600 .5451 .5434 .4406 .3507
605.2 .5483 .5476 .4912 .4019  610 .5423 .5423 .3656 .2768  615.2 .4961 .4887 .1856 .1438  619.2 .4475 .4313 .1281 .1120
625.2 .5261 .5364 .2904 .2107  630 .5453 .5657 .4652 .3778  640 .5403 .5705 .4333 .3413  650 .5212 .5649 .3687 .2718
660 .5298 .5583 .2653 .1837  667.2 .5206 .5423 .2059 .1426  670 .5260 .5532 .2340 .1600  678 .5494 .5966 .4226 .3243
683.2 .5342 .5748 .2806 .1930  690 .5407 .5934 .3549 .2585  700 .4938 .5352 .1635 .1129  703.2 .4849 .5168 .1357 .0978
710 .5088 .5631 .2224 .1472  716 .4905 .5384 .1680 .1143  720 .3692 .3807 .0630 .0612  727.2 .2120 .2106 .0438 .0434
735.2 .4127 .4419 .0735 .0654  740 .4975 .5540 .1770 .1159  745.2 .5238 .5954 .3099 .2163  750 .5214 .5923 .3035 .2101
760 .4784 .5717 .2550 .1668  768 .4710 .5504 .1671 .1079  780 .4197 .4784 .0719 .0592  786.8 .3387 .4480 .0586 .0529
793.2 .3507 .4298 .0486 .0465  800 .3753 .4165 .0474 .0470  810 .4440 .5080 .0802 .0600  820 .4811 .5680 .1815 .1272
830 .4990 .5837 .2406 .1797  836 .4498 .5176 .0950 .0650  841.2 .3801 .4173 .0396 .0394  843.2 .4382 .4901 .0617 .0486
850 .4521 .5368 .0933 .0631  855.2 .3812 .4171 .0390 .0390  862 .1763 .2060 .0238 .0272  870 .2811 .3279 .0278 .0320
875.2 .3435 .4041 .0354 .0368  880 .1825 .2694 .0254 .0301  883.2 .0360 .0561 .0160 .0166  887.2 .0196 .0325 .0133 .0130
895.2 .0434 .0564 .0158 .0168  900 .0841 .1092 .0169 .0197  905.2 .2319 .2861 .0224 .0272  910 .3628 .4328 .0369 .0356
920 .4098 .4782 .0525 .0402  930 .4154 .5400 .1682 .0992  939.2 .4577 .5571 .2704 .1825  950 .4484 .5211 .1051 .0607
960 .3903 .4427 .0406 .0334  970 .1904 .2353 .0145 .0191  980 .1775 .2557 .0161 .0217  990 .0732 .1090 .0113 .0139
1000 .1130 .1871 .0123 .0175  1010 .0711 .1022 .0091 .0122  1020 .1330 .2278 .0113 .0168  1030 .1751 .3101 .0106 .0137
1040 .2679 .4384 .0192 .0213  1050 .4039 .5355 .0748 .0448
""".split(), float).reshape(-1, 5)
# Not measured numbers: the places of the methane bands and windows are known, the heights are estimates.
GIANTS_INFRARED = np.array("""
1075 .40 .50 .09 .06  1100 .25 .30 .04 .03  1130 .08 .10 .008 .008  1170 .02 .03 .002 .002  1240 .20 .22 .015 .012
1275 .28 .30 .03 .025  1300 .22 .22 .015 .012  1340 .06 .06 .003 .003  1400 .02 .02 .001 .001  1500 .06 .06 .005 .005
1585 .20 .20 .03 .02  1620 .12 .12 .01 .008  1670 .02 .02 .001 .001  1850 .02 .02 .001 .001  1990 .06 .06 .001 .003
2050 .05 .05 .001 .003  2110 .02 .02 .001 .002  2200 .01 .01 .0005 .001  2500 .005 .005 .0005 .001
""".split(), float).reshape(-1, 5)

# Velikodsky et al. 2011, Icarus 214, 30: highland, mare (the Moon is 0.57 and 0.43 of them).
MOON = np.array("""
350 .0861 .0551  373 .0955 .0602  397 .1043 .0648  420 .1114 .0688  443 .1185 .0728  467 .1260 .0770  490 .1329 .0811
513 .1397 .0852  537 .1465 .0894  560 .1531 .0936  583 .1586 .0971  607 .1638 .1005  630 .1692 .1038  653 .1741 .1070
677 .1788 .1100  700 .1834 .1130  723 .1878 .1160  747 .1917 .1184  770 .1950 .1205  793 .1972 .1218  850 .2018 .1250
900 .2060 .1265  950 .2121 .1290  1000 .2200 .1330  1050 .2290 .1384  1100 .2381 .1451  1150 .2468 .1519
1200 .2551 .1585  1250 .2632 .1649  1300 .2702 .1704  1400 .2837 .1797  1500 .2985 .1909  1600 .3084 .1990
1700 .3163 .2052  1800 .3232 .2100  1900 .3310 .2146  2000 .3391 .2203  2100 .3491 .2267  2200 .3610 .2349
2300 .3747 .2457  2400 .3902 .2601  2500 .4022 .2730
""".split(), float).reshape(-1, 3)

# Madden and Kaltenegger 2018, Astrobiology 18, 1559: Mercury, shape only (MESSENGER's spectrometer).
MERCURY = columns("""
299.6 .00765 315.3 .00849 335.2 .00927 348.7 .01017 366.6 .01104 385.5 .01178 406.4 .01255 429.4 .01318 448.3 .01378
467.1 .01455 490.1 .01536 513.2 .01595 536.2 .01637 559.2 .01665 582.3 .01706 605.3 .01742 628.3 .01783 651.3 .01833
674.4 .01889 697.4 .01943 720.4 .01990 743.5 .02019 789.5 .02050 835.6 .02109 881.6 .02159 927.7 .02195 973.7 .02258
1019.8 .02334 1065.9 .02429 1106.7 .02523 1159 .02630 1216.6 .02694 1262.7 .02738 1308.7 .02765 1400.8 .02766
1470 .02763 1543 .02875 1639.5 .02982 1731.6 .03072 1800.7 .03070 1846.8 .03039 1903.5 .03242 1935.7 .03525
1991 .03603 2106 .03604 2198 .03610 2267.6 .03725 2308 .03618 2352 .0341""")

# Venus: 365 to 549 nm broad bands of Mallama et al. 2017; 300 to 340 nm the slope of Crow et al. 2011 (EPOXI, 315 and
# 359 nm); from 600 nm the shape of Madden and Kaltenegger 2018 (Meadows and Spencer) times 1.52, which joins Mallama.
VENUS = columns("""
300 .31 320 .322 340 .335 365 .348 400 .50 436 .658 480 .672 549 .689 600 .700""")
VENUS_MADDEN = columns("""
722.7 .4588 807.2 .4556 887.9 .4489 966.5 .4434 996.2 .4298 1051.5 .4440 1107.3 .4419 1154 .2604 1160 .4038 1183 .3345
1187.8 .2379 1212.7 .3016 1238.5 .4223 1262 .4094 1271 .3244 1287 .3858 1313 .4033 1338 .3104 1367 .4142 1399 .3239
1412.5 .2757 1430 .2139 1438.5 .3381 1458 .2482 1472.5 .3485 1503 .3958 1528 .2900 1563 .3540 1582 .2424 1615.9 .2072
1631.4 .2917 1646.4 .2313 1660 .2924 1701 .3051 1767.6 .3193 1861 .2993 1917 .2626 1945 .1933 1975.5 .0919 2006.4 .0682
2043 .0559 2097.6 .1061 2117 .1893 2167 .2326 2228.6 .2636 2301.5 .2578 2370 .2362 2445 .2136 2500 .1990""")

# Singer et al. 1979, JGR 84, 8415, figure 3: bright and dark areas of Mars, to be scaled to 0.40 and 0.21 at 800 nm.
MARS_BRIGHT = columns("""
330 .0917 342 .0960 363 .1087 381 .0990 404 .1308 440 .1806 475 .2476 504 .3025 540 .3983 566 .5277 600 .7042 633 .7901
666 .8612 700 .9080 716 .9510 740 .9739 757 1.008 786 .9987 799 1.002 822 .9846 850 .9693 876 .9627 900 .9691 936 .9767
973 .9864 998 .9798 1022 1.004 1047 .9969 1072 1.0348 1110 1.030 1148 1.023 1173 1.045 1211 1.008 1248 1.0435
1300 1.036 1332 1.038 1353 1.009 1398 .9493 1442 .8954 1486 .9644 1549 .9709 1600 .933 1655 .9722 1722 .9764
1787 1.022 1853 .9914 1876 .8890 1922 .8690 1945 .7773 1968 .7204 2012 .6585 2035 .6619 2058 .7189 2081 .7772
2104 .9027 2127 .9513 2174 .9902 2219 1.0003 2264 .9758 2306 .9398 2349 .9694 2413 .9484 2495 .9741""")
MARS_DARK = columns("""
330 .2143 342 .2260 363 .2083 381 .2072 404 .2424 440 .3046 475 .3683 504 .4358 540 .5529 566 .6867 600 .8322 633 1.006
656 1.0970 680 1.1284 704.7 1.1480 729 1.1434 752 1.1267 776 1.0927 799 1.0850 822 1.0338 850 1.0205 888 1.0248
924 1.0004 961 .9959 998 .9969 1034.5 1.0207 1072.5 1.0152 1123 1.0025 1173 .9813 1211 .9904 1248 .9795 1332 .9272
1375 .8695 1420 .9059 1486 .9135 1549 .8706 1612 .9027 1678 .9005 1744 .8605 1787 .8814 1853 .8214 1876 .7324
1922 .6940 1945 .6002 1991 .6783 2012 .7593 2035 .8236 2104 .8570 2150 .8385 2197 .8590 2264 .8578 2306 .8950
2349 .8505 2413 .8483 2435 .8671""")

# Clark and McCord 1980, Icarus 43, 161: Saturn's rings. The points below 640 nm (another instrument) are times 1.10.
RINGS = columns("""
326 .3132 343 .3528 360 .3933 383 .4455 403 .5112 435 .5886 469 .6966 500 .7686 534 .8604 566 .9000 599 .9234 633 .9612
644 .9832 668 .9899 692 .9934 716 .9990 740 .9812 764 .9935 799 .9567 837 .9444 876 .9249 912 .9181 948 .9364 973.5 .922
1010.8 .9129 1059.8 .9097 1097.8 .9061 1147.7 .8844 1185.5 .8577 1223 .8298 1261.5 .7972 1300 .8056 1329 .7910
1353 .7400 1398 .8089 1420 .7179 1442 .6492 1464 .4962 1486 .3638 1507 .2897 1549 .3002 1590 .3623 1612 .4042 1655 .3740
1677.5 .4610 1700 .5429 1744 .6115 1787 .6251 1831 .6479 1853 .6055 1876 .5341 1899 .4242 1922 .3115 1945 .2471
1968 .1900 2012 .1621 2058 .1594 2081 .1794 2104 .2358 2127 .3131 2150 .3805 2174 .4596 2197 .5060 2242 .5460 2264 .5213
2286 .4737 2306 .3983 2328 .3417 2370 .3118 2413 .2844 2455 .2656 2475 .2658""")

# Clark and McCord 1980, Icarus 41, 323: the Galilean moons, shape only.
IO = columns("""
350 .1269 375 .1612 400 .1900 433 .3127 466 .4553 500 .6420 533 .7754 566 .8014 600 .8116 633 .8901 666 .9430 700 1.0043
752 1.032 799 1.0157 850 .9737 900 .9897 948 1.0308 998 .9967 1047 .9933 1110 .9675 1160 .9175 1223 .9274 1261 .9387
1376 .9458 1420 .9767 1486 .9329 1525 .9007 1612 .8978 1700 .9063 1787 .9003 1876 .9322 1945 .8828 2012 .8626 2104 .8638
2197 .8241 2264 .8549 2349 .8332 2413 .7964 2495 .7869""")
EUROPA = columns("""
350 .3528 375 .4108 400 .4674 433 .6026 466 .6888 500 .8064 533 .8393 566 .8521 600 .9137 633 .9612 666 .9794 700 1.0066
766 1.0384 833 1.0629 900 1.0596 948 1.0546 998 1.0111 1047 .9812 1110 .9721 1160 .9102 1223 .8086 1275 .7704 1353 .8078
1420 .7362 1442 .6205 1464 .4981 1486 .4011 1525 .3351 1590 .3776 1655 .3768 1722 .4203 1808 .3997 1876 .3876 1899 .3090
1922 .2264 1968 .1533 2012 .1629 2104 .1798 2174 .2180 2242 .2345 2286 .2159 2349 .1830 2413 .1360 2495 .0974""")
GANYMEDE = columns("""
350 .4888 375 .5907 400 .6322 433 .7525 466 .7831 500 .8696 533 .9185 566 .9553 600 .9739 633 1.0108 666 1.0216 700 1.0467
766 1.0360 833 1.0441 900 1.0343 948 1.0422 998 1.0161 1047 .9752 1110 .9680 1160 .9039 1223 .8623 1261 .8100 1353 .8861
1420 .8750 1442 .8238 1464 .7031 1486 .5717 1525 .4588 1590 .4876 1655 .5278 1722 .6337 1787 .6812 1876 .6209 1899 .5488
1945 .3822 1991 .3343 2058 .3447 2127 .4160 2174 .5030 2242 .5484 2306 .4759 2370 .3948 2435 .3458 2495 .3126""")
CALLISTO = columns("""
350 .4062 375 .4561 400 .5181 433 .6522 466 .6913 500 .7777 533 .8406 566 .8815 600 .9187 633 .9415 666 .9693 700 .9908
766 .9935 833 .9870 900 .9798 961 1.0022 1022 1.0132 1098 .9856 1160 .9383 1223 .9370 1275 .9288 1353 .9833 1420 .9977
1464 .9054 1507 .7974 1569 .7620 1655 .7807 1744 .8363 1808 .8214 1876 .8538 1922 .7726 2012 .7131 2104 .7245 2174 .7497
2242 .7794 2306 .7498 2370 .6898 2435 .6619 2495 .6682""")
# Karkoschka 1998: Titan.
TITAN = columns("""
304 .056 320 .0573 340 .0629 360 .0703 380 .0791 400 .0898 420 .1028 440 .1147 460 .1301 480 .1472 500 .1670 520 .1864
535.2 .2005 542.4 .1990 550 .2163 570 .2333 590 .2539 605.2 .2626 613.2 .2442 619.2 .2220 625.2 .2607 635.2 .2838 650 .2826
667.2 .2618 677.2 .2976 683.2 .2817 692 .2968 702.8 .2449 712 .2808 720 .2048 727.2 .1679 740 .2667 752 .2991 768 .2628
780 .2226 794.4 .2030 798 .1950 810 .2286 820 .2882 830 .3029 836 .2307 841.6 .1855 846.4 .2267 854.8 .1861 862.4 .1338
875.2 .1749 880 .1383 887.6 .0742 895.2 .0850 905.2 .1415 910 .1752 920 .1879 930 .2444 939.6 .2746 950 .2102 960 .1692
970 .1173 980 .1167 988.8 .0823 1000 .1001 1012 .0808 1020 .1071 1030 .1152 1040 .1409 1050 .1808""")

# Khuller et al. 2021, JGR Planets 126, e2021JE006910: clean snow of 350 micrometre grains (computed from measured ice).
SNOW = columns("""
300 .9965 350 .9968 390 .9969 420 .9962 450 .9938 480 .9894 500 .9850 520 .9802 540 .9748 560 .9692 580 .9634 600 .9579
620 .9491 640 .9410 660 .9321 680 .9252 700 .9141 720 .9009 740 .8924 760 .8729 780 .8529 800 .8348 830 .8318 850 .8152
870 .7843 890 .7467 910 .7355 930 .7218 950 .7047 970 .6517 990 .6028 1010 .5420 1030 .5200 1050 .5345 1070 .5666
1100 .5807 1120 .5726 1150 .5405 1170 .4560 1200 .3632 1220 .2942 1240 .2672 1270 .2544 1300 .2615 1330 .2649
1360 .2566 1390 .2278 1400 .2094 1420 .0827 1440 .0292 1460 .0128 1490 .0067 1550 .0088 1600 .0146 1650 .0196
1700 .0271 1750 .0349 1800 .0405 1830 .0452 1860 .0411 1880 .0261 1900 .0134 1930 .0053 2000 .0041 2050 .0042
2100 .0057 2150 .0129 2200 .0236 2250 .0316 2300 .0211 2350 .0114 2400 .0086 2500 .0061""")

# Gomez 2014, Geofisica Internacional 53, 385: clear water of the Caribbean Sea.
WATER = columns("380 .048 400 .047 425 .043 450 .037 475 .032 500 .020 520 .010 550 .007 600 .004 650 .002 700 .001 750 0")
# Hale and Querry 1973, Applied Optics 12, 555.
WATER_N = columns("""
300 1.349 325 1.346 350 1.343 375 1.341 400 1.339 425 1.338 450 1.337 475 1.336 500 1.335 525 1.334 550 1.333 575 1.333
600 1.332 625 1.332 650 1.331 675 1.331 700 1.331 725 1.330 750 1.330 775 1.330 800 1.329 825 1.329 850 1.329 875 1.328
900 1.328 925 1.328 950 1.327 975 1.327 1000 1.327 1200 1.324 1400 1.321 1600 1.317 1800 1.312 2000 1.306 2200 1.296
2400 1.279 2600 1.242""")
WATER_K = columns("""
300 1.6e-8 350 6.5e-9 400 1.86e-9 450 1.02e-9 500 1.00e-9 550 1.96e-9 600 1.09e-8 650 1.64e-8 700 3.35e-8 750 1.56e-7
800 1.25e-7 850 2.93e-7 900 4.86e-7 950 2.93e-6 1000 2.89e-6 1200 9.89e-6 1400 1.38e-4 1600 8.55e-5 1800 1.15e-4
2000 1.10e-3 2200 2.89e-4 2400 9.56e-4 2600 3.17e-3""")

# Neckel and Labs 1994, Solar Physics 153, 91, table 1: wavelength, A0 ... A5, disc mean over disc centre.
LIMB = """
303.327 0.08011 0.70695 0.49910 -0.31080 -0.02177 0.04642 0.6826
310.843 0.08160 0.71609 0.69685 -0.87703 0.47008 -0.08760 0.6883
320.468 0.08833 0.77285 0.65382 -1.04647 0.72921 -0.19775 0.6985
329.897 0.09188 0.92459 0.19604 -0.39546 0.23599 -0.05303 0.7116
349.947 0.11012 1.02168 -0.10924 -0.00055 -0.08688 0.06487 0.7260
365.875 0.12828 1.04969 0.17682 -1.13371 1.23882 -0.45990 0.7445
374.086 0.12579 0.85402 0.54601 -1.15048 0.88928 -0.26462 0.7288
390.915 0.12995 0.91836 -0.07566 0.19149 -0.28712 0.12298 0.7204
401.970 0.12323 1.08648 -0.43974 0.45912 -0.32759 0.09850 0.7303
416.319 0.12814 1.19947 -0.84407 1.07201 -0.79537 0.23982 0.7380
427.930 0.14249 1.28796 -1.19564 1.68603 -1.36658 0.44572 0.7495
443.885 0.16220 1.24893 -0.92165 0.89978 -0.50148 0.11220 0.7588
445.125 0.15248 1.38517 -1.49615 1.99886 -1.48155 0.44119 0.7596
457.345 0.16604 1.38544 -1.52275 2.00232 -1.45969 0.42864 0.7651
477.427 0.19571 1.30551 -1.25845 1.50626 -1.05472 0.30570 0.7751
492.905 0.20924 1.30798 -1.20411 1.21505 -0.67196 0.14381 0.7823
519.930 0.23695 1.29927 -1.28034 1.37760 -0.85054 0.21706 0.7925
541.760 0.26073 1.27428 -1.30352 1.47085 -0.96618 0.26384 0.8002
559.950 0.26892 1.34319 -1.58427 1.91271 -1.31350 0.37295 0.8061
579.880 0.28392 1.36896 -1.75998 2.22154 -1.56074 0.44630 0.8125
610.975 0.30854 1.36620 -1.83572 2.33221 -1.63082 0.45959 0.8221
640.970 0.33644 1.30590 -1.79238 2.45040 -1.89979 0.59943 0.8290
669.400 0.34685 1.37539 -2.04425 2.70493 -1.94290 0.55999 0.8360
700.875 0.37885 1.25553 -1.70908 2.19647 -1.59554 0.47378 0.8434
748.710 0.40627 1.22842 -1.67877 2.05535 -1.39972 0.38845 0.8524
811.760 0.42977 1.25182 -1.85164 2.31949 -1.59101 0.44155 0.8621
869.600 0.45396 1.25101 -2.02958 2.75410 -2.02287 0.59338 0.8701
948.850 0.47855 1.19813 -1.86296 2.36939 -1.64367 0.46056 0.8773
1046.60 0.49870 1.21429 -2.06976 2.80703 -2.05247 0.60221 0.8841
1098.95 0.51149 1.19354 -2.00174 2.66936 -1.94981 0.57715 0.8890
"""

# Ozone, cross-section in 1e-23 cm^2 at about 223 K. Rounded values; see the field `source`.
OZONE = columns("""
300 34000 310 9000 320 2600 330 560 340 130 350 26 360 5 380 1 400 1 420 3 440 12 450 17 460 36 480 70 500 123 520 180
540 290 560 390 575 480 585 460 600 510 605 515 620 400 640 290 660 210 680 136 700 87 720 53 740 39 760 27 780 24
800 16 850 10 900 5 1000 1""")

# High-pressure sodium, relative power. An estimate of the usual lamp: broad self-reversed D lines, sodium lines, xenon.
SODIUM = columns("""
300 0 400 .02 440 .04 448 .05 454 .07 466 .16 470 .09 480 .06 494 .10 498 .38 502 .10 510 .08 515 .20 520 .07 540 .06
550 .09 558 .18 566 .55 569 .80 573 .55 579 .75 583 1.00 587 .55 589.3 .18 592 .55 597 .95 602 .80 610 .58 616 .62
620 .42 640 .27 660 .21 675 .19 700 .13 740 .11 760 .12 766 .30 771 .22 780 .12 810 .14 818 .85 822 .75 830 .16
860 .08 900 .07 1000 .06 1138 .35 1150 .08 1300 .05 2200 .03 2500 .02""")


def jhu(path):
    w, r = [], []
    for line in open(path, encoding="latin-1"):
        p = line.split()
        try:
            a, b = float(p[0]), float(p[1])
        except (ValueError, IndexError):
            continue
        if len(p) == 2:
            w.append(a * 1000)
            r.append(b / 100)
    order = np.argsort(w)
    return np.array(w)[order], np.clip(np.array(r)[order], 0, None)


def smooth(w, r, grid):
    """Means over the neighbourhood of each grid point; held constant beyond the ends."""
    edges = np.concatenate([[grid[0]], (grid[1:] + grid[:-1]) / 2, [grid[-1]]])
    out = []
    for lo, hi, g in zip(edges[:-1], edges[1:], grid):
        x = np.linspace(lo, hi, 9)
        out.append(np.interp(x, w, r).mean() if lo != hi else np.interp(g, w, r))
    return np.array(out)


def cloud(w):
    """Two-stream reflectance of a cloud, optical depth 25, drops of 10 micrometres."""
    tau, g, radius_nm = 25, 0.86, 10e3
    k = np.exp(np.interp(w, WATER_K[0], np.log(WATER_K[1])))
    loss = np.minimum(0.85 * 4 * np.pi * k / w * radius_nm * 2 / 1.5 / 2, 0.45)  # 1 - single-scattering albedo
    omega = 1 - loss
    gamma1, gamma2 = (7 - omega * (4 + 3 * g)) / 4, -(1 - omega * (4 - 3 * g)) / 4  # Eddington
    gamma2 = np.maximum(gamma2, 0)
    k2 = np.sqrt(np.maximum(gamma1 ** 2 - gamma2 ** 2, 1e-12))
    t = np.tanh(k2 * tau)
    return gamma2 * t / (k2 + gamma1 * t)

# What shines above the air: wavelength in nm, power per nm.
AIRGLOW = [
    (300, 0), (400, 0.9), (450, 1), (500, 1), (555.7, 1), (557.7, 42), (559.7, 1), (587.3, 0.95), (589.3, 8.8),
    (591.3, 0.95), (650, 0.9), (700, 2), (760, 10), (840, 30), (1000, 120), (1300, 450), (1600, 800), (1800, 700),
    (2100, 600), (2300, 0), (2500, 0),
]
AURORA = [
    (300, 0), (389.4, 0.3), (391.4, 35), (393.4, 0.3), (425.8, 0.2), (427.8, 9.8), (429.8, 0.1), (468.9, 0.1),
    (470.9, 1.9), (472.9, 0.05), (555.7, 0.05), (557.7, 49), (559.7, 0.05), (590, 0.2), (600, 0.4), (660, 0.5),
    (690, 0.3), (750, 1.1), (900, 0.7), (1100, 0.4), (1300, 0), (2500, 0),
]
HIGH_AURORA = [
    (300, 0), (425.8, 0), (427.8, 3), (429.8, 0), (555.7, 0), (557.7, 4.9), (559.7, 0), (628, 0), (630, 32.7),
    (632, 0.3), (634.4, 0.3), (636.4, 10.8), (638.4, 0), (2500, 0),
]


def main(folder, out):
    kinds = {}

    def add(name, w, r, source, measured, **more):
        kinds[name] = {"source": source, "measured_nm": measured,
                       "reflectance": [[round(float(a), 1), round(float(b), 4)] for a, b in zip(w, r)], **more}

    def ends(w, r):
        w, r = list(w), list(r)
        return np.array([300, *w] if w[0] > 300 else w), np.array([r[0], *r] if w[0] > 300 else r)

    def both(w, r):
        w, r = ends(w, r)
        return (np.append(w, 2500), np.append(r, r[-1])) if w[-1] < 2500 else (w, r)

    add("water", *both(WATER[0], WATER[1]), "Gomez 2014, Geofisica Internacional 53, 385: light that comes up out of "
        "clear sea water, without the glint; 300 to 380 nm held, zero from 750 nm", [380, 700],
        refractive_index={"source": "Hale and Querry 1973, Applied Optics 12, 555",
                          "n": [[float(a), float(b)] for a, b in zip(*WATER_N)]})
    veg = [jhu(f"{folder}/vegetation/txt/{n}.txt") for n in ("grass", "decidous", "conifers")]
    first = max(v[0][0] for v in veg)
    add("vegetation", BASE, np.mean([smooth(*v, BASE) for v in veg], axis=0),
        "mean of green grass, deciduous and conifer leaves, Johns Hopkins University (ASTER spectral library; "
        "Baldridge et al. 2009, RSE 113, 711)", [round(float(first)), 2500])
    soils = [jhu(f"{folder}/soils/txt/{n}.txt") for n in ("89P1763c", "89P1805c", "82P2695c")]
    first = max(v[0][0] for v in soils)
    add("soil", BASE, np.mean([smooth(*v, BASE) for v in soils], axis=0),
        "mean of three light soils (light yellowish brown clay 89P1763, dark yellowish brown silty clay 89P1805, very "
        "pale brown to brownish yellow silt loam 82P2695), Johns Hopkins University (ASTER spectral "
        "library; Baldridge et al. 2009, RSE 113, 711)", [round(float(first)), 2500])
    add("snow", *both(*SNOW), "Khuller et al. 2021, JGR Planets 126, e2021JE006910: clean snow of 350 micrometre "
        "grains, computed from ice's measured optical constants (Warren and Brandt 2008)", [300, 2500])
    add("cloud", BASE, cloud(BASE), "computed, not measured: two-stream (Eddington) cloud of optical depth 25, drops "
        "of 10 micrometres, water's absorption after Hale and Querry 1973", [], optical_depth=25)
    for i, n in ((1, "moon-highland"), (2, "moon-mare")):
        add(n, *both(MOON[:, 0], MOON[:, i]), "Velikodsky et al. 2011, Icarus 214, 30; below 350 nm held", [350, 2500])
    w, r = both(*MERCURY)
    add("mercury", w, r * 0.142 / np.interp(549, *MERCURY), "Madden and Kaltenegger 2018, Astrobiology 18, 1559 "
        "(MESSENGER MASCS), scaled to geometric albedo 0.142 in V (Mallama et al. 2017)", [300, 2352])
    w = np.concatenate([VENUS[0], VENUS_MADDEN[0]])
    r = np.concatenate([VENUS[1], VENUS_MADDEN[1] * 1.52])
    add("venus", w, r, "300 to 340 nm slope of Crow et al. 2011, ApJ 729, 130; 365 to 549 nm bands of Mallama et al. "
        "2017, Icarus 282, 19; from 723 nm Madden and Kaltenegger 2018 times 1.52", [315, 2500])
    for n, (w, r), a in (("mars-bright", MARS_BRIGHT, 0.40), ("mars-dark", MARS_DARK, 0.21)):
        w2, r2 = both(w, r)
        add(n, w2, r2 * a / np.interp(800, w, r), f"Singer et al. 1979, JGR 84, 8415, figure 3, {a:.2f} at 800 nm",
            [330, int(w[-1])])
    g = np.vstack([GIANTS, GIANTS_INFRARED])
    for i, n, v in ((1, "jupiter", 0.538), (2, "saturn", 0.499), (3, "uranus", 0.488), (4, "neptune", 0.442)):
        band = np.exp(-0.5 * ((GIANTS[:, 0] - 545) / 36) ** 2) * np.gradient(GIANTS[:, 0])
        v0 = (band * GIANTS[:, i]).sum() / band.sum()
        w, r = ends(g[:, 0], g[:, i])
        add(n, w, r * v / v0, f"Karkoschka 1998, Icarus 133, 134 (NASA PDS, 1995LOW.TAB), scaled by {v / v0:.3f} to "
            f"geometric albedo {v} in V (Mallama et al. 2017); beyond 1050 nm an estimate, not measured", [300, 1050])
        if n == "jupiter":
            for name, sign in (("jupiter-zone", 1), ("jupiter-belt", -1)):
                f = 1 + sign * np.interp(w, [300, 430, 550, 650, 2500], [0.22, 0.25, 0.13, 0.06, 0.06])
                add(name, w, r * v / v0 * f, "jupiter's times 1 + c or 1 - c, so that half of each is the disc; c is 0.25 at "
                    "430 nm, 0.13 at 550 nm, 0.06 from 650 nm: an estimate of the usual contrast", [300, 1050])
    w, r = both(*RINGS)
    add("rings", w, r / np.interp(550, *RINGS), "Clark and McCord 1980, Icarus 43, 161; 1 at 550 nm", [326, 2475])
    for n, t, v in (("io", IO, 0.63), ("europa", EUROPA, 0.67), ("ganymede", GANYMEDE, 0.43), ("callisto", CALLISTO, 0.17)):
        w, r = both(*t)
        add(n, w, r * v / np.interp(550, *t), f"Clark and McCord 1980, Icarus 41, 323, scaled to geometric albedo {v} in V "
            "(Allen's Astrophysical Quantities, rounded)", [350, 2495])
    w, r = both(*TITAN)
    add("titan", w, r, "Karkoschka 1998, Icarus 133, 134 (NASA PDS, 1995LOW.TAB), geometric albedo as printed; beyond 1050 nm "
        "held, too bright within the methane bands", [304, 1050])
    limb = np.array(LIMB.split(), float).reshape(-1, 8)
    a, ratio = limb[:, 1:7], limb[:, 7]
    one, mean = a.sum(1), (2 * a / (np.arange(6) + 2)).sum(1)
    print("limb darkening: worst sum of A - 1:", abs(one - 1).max(), " worst F/I against the table:", abs(mean - ratio).max())
    data = {
        "units": "[wavelength in nm (vacuum or air: not told apart), value]. Straight lines between points. 300 and 2500 "
                 "nm are the ends; beyond them hold the last value.",
        "meaning": "water, vegetation, soil, snow, cloud: hemispherical reflectance (albedo). moon, mercury, venus, mars, "
                   "jupiter, saturn, uranus, neptune: geometric albedo, the full face against a white Lambert disc. A "
                   "sphere shaded by Lambert's law has 2/3 of its reflectance as geometric albedo, so divide by 2/3 "
                   "for Lambert shading. rings: 1 at 550 nm, to be multiplied by the profile's reflectivity.",
        "kinds": kinds,
        "lights": {"city-lights": {
            "source": "an estimate of a high-pressure sodium lamp's spectrum, not a measured table: self-reversed sodium D "
                      "lines, sodium lines at 498, 515, 568, 616, 818 and 1138 nm, on a weak continuum",
            "measured_nm": [], "relative_power": [[float(x), float(y)] for x, y in zip(*SODIUM)]},
            "airglow": {
                "source":
                    "an estimate from typical strengths, not a measured table: a continuum of 3 R/nm with the lines "
                    "of oxygen at 557.7 nm, 250 R, and of sodium at 589.3 nm, 50 R (Roach and Gordon 1973, The light "
                    "of the night sky), and the hydroxyl's bands from 700 nm, 4.5 MR in all; lines are 2 nm wide",
                "measured_nm": [], "relative_power": [[float(x), float(y)] for x, y in AIRGLOW]},
            "aurora": {
                "source":
                    "an estimate from typical strengths, not a measured table: 100 R of oxygen at 557.7 nm go with "
                    "50 R of ionized nitrogen at 391.4 nm, 15 R at 427.8 nm, 3 R at 470.9 nm, and nitrogen's bands "
                    "from 590 nm (Vallance Jones 1974, Aurora); lines are 2 nm wide",
                "measured_nm": [], "relative_power": [[float(x), float(y)] for x, y in AURORA]},
            "high-aurora": {
                "source":
                    "an estimate from typical strengths, not a measured table: oxygen at 630.0 and 636.4 nm, three "
                    "to one, with a tenth as much at 557.7 nm and some nitrogen at 427.8 nm (Vallance Jones 1974, "
                    "Aurora); lines are 2 nm wide",
                "measured_nm": [], "relative_power": [[float(x), float(y)] for x, y in HIGH_AURORA]}},
        "sun_limb_darkening": {
            "source": "Neckel and Labs 1994, Solar Physics 153, 91, table 1. The printed A2 at 365.875 nm, 0.17482, breaks "
                      "the paper's own sum; 0.17682 mends it. All rows: sum of A is 1 within 2e-5, disc mean over "
                      "centre as printed within 1e-4.",
            "rule": "I(mu)/I(1) = sum A_k mu^k, straight lines in wavelength between rows; below 303 nm the first row. "
                    "Beyond 1098.95 nm: 1 - u (1 - mu), times nothing else, with the u below (straight lines), from "
                    "Pierce and Slaughter's 1977 trend; an estimate within 0.03.",
            "rows": [[float(v) for v in row[:7]] for row in limb],
            "infrared_u": [[1098.95, 0.33], [1250, 0.29], [1600, 0.22], [2000, 0.19], [2500, 0.16]]},
        "ozone": {
            "source": "Rounded from the usual tables (Serdyuchenko et al. 2014, Molina and Molina 1986; written down "
                      "from memory, about 10 percent).",
            "column_300_du_cm2": 8.07e18,
            "optical_depth_300_du": [[float(x), float(f"{y * 1e-23 * 8.07e18:.3g}")] for x, y in zip(*OZONE)]},
    }
    with open(out, "w", encoding="utf-8") as f:
        import re
        text = json.dumps(data, indent=1)
        text = re.sub(r"\[\s+(-?[\d.e+-]+(?:,\s+-?[\d.e+-]+)*)\s+\]",
                      lambda m: "[" + re.sub(r"\s+", " ", m.group(1)) + "]", text)
        text = re.sub(r"\],\n\s+\[", "], [", text)
        f.write(text + "\n")
    for n, k in kinds.items():
        w, r = np.array(k["reflectance"]).T
        print(f"{n:14} {len(w):3} points", *(f"{x}:{np.interp(x, w, r):.3f}" for x in (450, 550, 650, 850, 1600, 2200)))


main(*sys.argv[1:])
