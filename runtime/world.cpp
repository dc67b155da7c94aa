#include "world.h"
#include <cmath>
namespace starbow {
World load_world(const std::filesystem::path&)
{
    World w;
    auto sphere=[&](double r,int n){ Primitive p{(uint32_t)w.indices.size(),0,(int)w.vertices.size(),0,{0,0,0},r};
      for(int j=0;j<=n;++j)for(int i=0;i<=2*n;++i){ float t=3.14159265f*j/n,f=3.14159265f*i/n; glm::vec3 d(std::sin(t)*std::cos(f),std::cos(t),std::sin(t)*std::sin(f));
        bool dark=((i/4)+(j/4))&1; w.vertices.push_back({d*float(r),d,{float(i)/(2*n),float(j)/n},dark?0xff4060c0u:0xffe0e0e0u});}
      for(int j=0;j<n;++j)for(int i=0;i<2*n;++i){uint32_t a=j*(2*n+1)+i,b=a+1,c=a+2*n+1,d=c+1; for(uint32_t k:{a,b,c,b,d,c}) w.indices.push_back(k);} // outward ccw?
      p.index_count=w.indices.size()-p.first_index; w.primitives.push_back(p); return int(w.primitives.size())-1; };
    w.materials.push_back({});
    int s=sphere(0.3,32);
    for(int k=-10;k<20;++k)for(int x:{-1,1})for(int y:{-1,1}){ glm::dmat4 m(1); m[3]=glm::dvec4(x*0.8,y*0.6,-3-2*k,1); w.instances.push_back({m,(uint32_t)s}); }
    return w;
}
}
