#include <cstdio>
#include <cstdlib>
#include <map>
#include <random>
#include <set>
#include <string>
#include <algorithm>
#include <cmath>
#include <vector>
#include <array>
#include <plexway/tetgen/tetrahedralize.hpp>
using P=std::array<double,3>; using plexway::Index;
P operator-(P a,P b){return {a[0]-b[0],a[1]-b[1],a[2]-b[2]};}
P operator+(P a,P b){return {a[0]+b[0],a[1]+b[1],a[2]+b[2]};}
P operator*(double s,P a){return {s*a[0],s*a[1],s*a[2]};}
double dot(P a,P b){return a[0]*b[0]+a[1]*b[1]+a[2]*b[2];}
P cross(P a,P b){return {a[1]*b[2]-a[2]*b[1],a[2]*b[0]-a[0]*b[2],a[0]*b[1]-a[1]*b[0]};}
double norm(P a){return std::sqrt(dot(a,a));}
struct Convex{std::vector<P> v; std::vector<std::vector<Index>> f; std::vector<std::array<Index,2>> e; std::vector<P> n; std::vector<double> o; P c;
 void finish(){c={0,0,0};for(auto&p:v)c=c+(1.0/v.size())*p; std::set<std::pair<Index,Index>> s;
  for(auto&g:f){P m=cross(v[g[1]]-v[g[0]],v[g[2]]-v[g[0]]); m=(1/norm(m))*m; if(dot(m,v[g[0]]-c)<0)m=-1.0*m; n.push_back(m);o.push_back(dot(m,v[g[0]]));
   for(size_t i=0;i<g.size();++i){Index a=g[i],b=g[(i+1)%g.size()]; s.insert({std::min(a,b),std::max(a,b)});}}
  for(auto&x:s)e.push_back({x.first,x.second});}
 // does the segment cross the interior
 bool blocks(P p,P q,double eps=1e-9)const{double lo=0,hi=1;for(size_t i=0;i<n.size();++i){double a=dot(n[i],p)-o[i]+eps,b=dot(n[i],q)-o[i]+eps; if(a>=0&&b>=0)return false; if(a>0)lo=std::max(lo,a/(a-b)); else if(b>0)hi=std::min(hi,a/(a-b)); if(lo>=hi)return false;} return hi>lo;}
 bool contains(P p)const{for(size_t i=0;i<n.size();++i)if(dot(n[i],p)-o[i]>1e-12)return false;return true;}
};
struct Rot{double m[3][3]; Rot(double a,double b,double c){double ca=cos(a),sa=sin(a),cb=cos(b),sb=sin(b),cc=cos(c),sc=sin(c);
 double r[3][3]={{cb*cc,-cb*sc,sb},{sa*sb*cc+ca*sc,-sa*sb*sc+ca*cc,-sa*cb},{-ca*sb*cc+sa*sc,ca*sb*sc+sa*cc,ca*cb}}; for(int i=0;i<3;++i)for(int j=0;j<3;++j)m[i][j]=r[i][j];}
 P operator()(P p)const{P q;for(int i=0;i<3;++i)q[i]=m[i][0]*p[0]+m[i][1]*p[1]+m[i][2]*p[2];return q;}};
Convex box(P h,P at,Rot r){Convex c;for(int i=0;i<8;++i)c.v.push_back(r(P{(i&1?1:-1)*h[0],(i&2?1:-1)*h[1],(i&4?1:-1)*h[2]}+at));
 c.f={{0,2,3,1},{4,5,7,6},{0,1,5,4},{2,6,7,3},{0,4,6,2},{1,3,7,5}};c.finish();return c;}
Convex tetra(P a,P b,P d,P e){Convex c;c.v={a,b,d,e};c.f={{0,1,2},{0,1,3},{0,2,3},{1,2,3}};c.finish();return c;}
Convex pyramid(double half,double z0,double z1,Rot r){Convex c;c.v={r({-half,-half,z0}),r({half,-half,z0}),r({half,half,z0}),r({-half,half,z0}),r({.03,.02,z1})};c.f={{0,1,2,3},{0,1,4},{1,2,4},{2,3,4},{3,0,4}};c.finish();return c;}
struct Truth{const std::vector<Convex>&ob; struct E{P a,b;}; std::vector<E> edges; int m; std::vector<P> nodes; std::vector<int> of; std::vector<std::vector<std::pair<int,double>>> adj;
 bool free(P p,P q)const{for(auto&c:ob)if(c.blocks(p,q))return false;return true;}
 Truth(const std::vector<Convex>&o,int m_):ob(o),m(m_){for(auto&c:ob)for(auto&x:c.e)edges.push_back({c.v[x[0]],c.v[x[1]]});
  for(size_t e=0;e<edges.size();++e)for(int i=0;i<=m;++i){nodes.push_back(edges[e].a+(double(i)/m)*(edges[e].b-edges[e].a));of.push_back(e);}
  adj.resize(nodes.size());for(size_t i=0;i<nodes.size();++i)for(size_t j=i+1;j<nodes.size();++j)if(free(nodes[i],nodes[j])){double l=norm(nodes[i]-nodes[j]);adj[i].push_back({j,l});adj[j].push_back({i,l});}}
 P on(int e,double t)const{return edges[e].a+t*(edges[e].b-edges[e].a);}
 double bend(int e,P p,P q)const{P u=edges[e].b-edges[e].a;double L=norm(u);u=(1/L)*u;P a=p-edges[e].a,b=q-edges[e].a;double xa=dot(a,u),xb=dot(b,u);double ha=norm(a-xa*u),hb=norm(b-xb*u);double x=ha+hb>0?(xa*hb+xb*ha)/(ha+hb):xa;return std::clamp(x/L,0.,1.);}
 double refine(P s,P q,const std::vector<int>&seq,std::vector<double>&t)const{size_t k=seq.size();double last=1e300,len=0;std::vector<P> b(k);for(size_t i=0;i<k;++i)b[i]=on(seq[i],t[i]);
  for(int it=0;it<3000;++it){for(size_t i=0;i<k;++i){t[i]=bend(seq[i],i?b[i-1]:s,i+1<k?b[i+1]:q);b[i]=on(seq[i],t[i]);}
   len=norm(b[0]-s)+norm(q-b[k-1]);for(size_t i=1;i<k;++i)len+=norm(b[i]-b[i-1]); if(k==1||last-len<1e-15)break;last=len;}
  bool ok=free(s,b[0])&&free(b[k-1],q);for(size_t i=1;i<k;++i)ok=ok&&free(b[i-1],b[i]);return ok?len:1e300;}
 void solve(P s,const std::vector<P>&qs,std::vector<double>&d,std::vector<char>&sight){size_t N=nodes.size();std::vector<double> dist(N,1e300);std::vector<int> par(N,-1);std::vector<char> done(N,0);
  for(size_t i=0;i<N;++i)if(free(s,nodes[i]))dist[i]=norm(nodes[i]-s);
  for(size_t it=0;it<N;++it){int b=-1;for(size_t i=0;i<N;++i)if(!done[i]&&(b<0||dist[i]<dist[b]))b=i;done[b]=1;for(auto[j,l]:adj[b])if(dist[b]+l<dist[j]-1e-12){dist[j]=dist[b]+l;par[j]=b;}}
  std::vector<std::pair<double,int>> c(N);
  for(P q:qs){if(free(s,q)){d.push_back(norm(q-s));sight.push_back(1);continue;}sight.push_back(0);
   for(size_t i=0;i<N;++i)c[i]={dist[i]+norm(q-nodes[i]),int(i)};std::sort(c.begin(),c.end());double best=1e300;std::set<std::vector<int>> tried;
   for(auto[v,i]:c){if(best<1e299&&(v>best*(1+3e-3)||tried.size()>=14))break;if(!free(nodes[i],q))continue;best=std::min(best,v);
    std::vector<int> seq;std::vector<double> t;for(int n=i;n>=0;n=par[n]){if(!seq.empty()&&seq.back()==of[n])continue;seq.push_back(of[n]);t.push_back(0);P u=edges[of[n]].b-edges[of[n]].a;t.back()=dot(nodes[n]-edges[of[n]].a,u)/dot(u,u);}
    std::reverse(seq.begin(),seq.end());std::reverse(t.begin(),t.end());if(!tried.insert(seq).second)continue;best=std::min(best,refine(s,q,seq,t));}
   d.push_back(best);}}
};
#include <fstream>
int main(int argc,char**argv){
 double tets=argc>1?atof(argv[1]):25000; std::string only=argc>2?argv[2]:"";
 Rot id(0,0,0),r1(.4,.7,.3),r2(1.1,.35,-.6);
 std::map<std::string,std::vector<Convex>> dom;
 dom["box"]={box({.35,.45,.3},{.05,.02,-.03},id)};
 dom["rbox"]={box({.35,.5,.25},{.05,.02,-.03},r1)};
 dom["plate"]={box({.6,.5,.03},{0,.05,.02},r2)};
 dom["tetra"]={tetra(r1({.6,.5,.5}),r1({-.55,-.5,.45}),r1({-.5,.6,-.5}),r1({.5,-.45,-.55}))};
 dom["cross"]={box({.7,.12,.1},{0,.0,.17},r1),box({.1,.75,.13},{.05,0,-.17},r1)};
 dom["bars3"]={box({.7,.12,.1},{0,.1,.3},r2),box({.1,.6,.13},{.25,0,-.05},r2),box({.12,.1,.6},{-.2,-.25,-.1},r2)};
 dom["spike"]={pyramid(.12,-.8,.8,r1)};
 std::vector<P> spots={{-.83,.11,.17},{.61,-.72,.43},{-.2,-.9,-.85}};
 for(auto&[name,ob]:dom){ if(!only.empty()&&only!=name)continue;
  plexway::tetgen::PiecewiseLinearComplex plc; Convex outer=box({1,1,1},{0,0,0},id);
  auto add=[&](const Convex&c){Index f0=plc.positions.size();for(P p:c.v)plc.positions.push_back(p);for(auto&g:c.f){std::vector<Index> poly;for(Index i:g)poly.push_back(f0+i);plc.facets.push_back({{poly},{}});}};
  add(outer);for(auto&c:ob){add(c);plc.holes.push_back(c.c);}
  plexway::tetgen::TetrahedralizeOptions opt;opt.max_volume=2.8*8/tets;
  auto solid=plexway::tetgen::tetrahedralize(plc,opt);
  auto&pos=solid.positions; printf("%s %zu vertices %zu tets\n",name.c_str(),pos.size(),solid.tets.size());fflush(stdout);
  Truth truth(ob,ob.size()==1?60:ob.size()==2?40:32);
  std::vector<char> used(pos.size(),0);for(auto&t:solid.tets)for(Index v:t)used[v]=1;
  struct Src{Index vertex,tet;double b[4];P at;};std::vector<Src> src;
  auto nearest=[&](P s,bool off){Index best=~0u;for(Index v=0;v<pos.size();++v){if(!used[v])continue; if(off){bool in=false;for(auto&c:ob)in|=c.contains(pos[v]);if(in)continue;} if(best==~0u||norm(pos[v]-s)<norm(pos[best]-s))best=v;}return best;};
  for(P s:spots){Index v=nearest(s,true);src.push_back({v,~0u,{0,0,0,0},pos[v]});}
  {P s=ob[0].v[0]+.3*(ob[0].v[1]-ob[0].v[0]);s=s+.04*(1/norm(s-ob[0].c))*(s-ob[0].c);Index v=nearest(s,true);src.push_back({v,~0u,{0,0,0,0},pos[v]});}
  {P s=(1/3.)*(ob[0].v[0]+ob[0].v[1]+ob[0].v[2]);s=s+.05*ob[0].n[0];Index best=0;double g=1e9;for(Index t=0;t<solid.tets.size();++t){P c={0,0,0};for(Index v:solid.tets[t])c=c+.25*pos[v];if(norm(c-s)<g)g=norm(c-s),best=t;}
   Src x{~0u,best,{.2,.3,.15,.35},{0,0,0}};for(int i=0;i<4;++i)x.at=x.at+x.b[i]*pos[solid.tets[best][i]];src.push_back(x);}
  std::ofstream out("d/"+name+(tets==25000?"":std::to_string(int(tets))),std::ios::binary);auto w=[&](const void*p,size_t n){out.write((const char*)p,n);};
  Index n[3]={Index(pos.size()),Index(solid.tets.size()),Index(src.size())};w(n,12);w(pos.data(),24*pos.size());w(solid.tets.data(),16*solid.tets.size());
  for(auto&s:src){std::vector<double> d;std::vector<char> sight;truth.solve(s.at,pos,d,sight);for(size_t v=0;v<pos.size();++v)if(!used[v])d[v]=-1;
   int lit=0;for(char c:sight)lit+=c;printf("  source %g %g %g lit %d\n",s.at[0],s.at[1],s.at[2],lit);fflush(stdout);
   w(&s,sizeof s);w(d.data(),8*d.size());w(sight.data(),sight.size());}
 }
}
