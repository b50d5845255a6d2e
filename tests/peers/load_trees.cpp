// Loads files of trees into BehaviorTree.CPP and runs them on scripted nodes: `make peers BTCPP=DIR` builds and uses it.
//
// The path of a file on each line of the input; for each the trace of its run, then `end STATUS` or `refused WHY`.
// `scripted.py` makes the same trace with the player in `emit/bt_player.py`, so that both can be compared.
// Every node that a file declares is registered with the ports and types of its TreeNodesModel. Time is virtual: a tick
// takes 100 ms, so Sleep and Timeout are replaced by nodes that read the same ports and count ticks.

#include <iostream>
#include <set>

#include "behaviortree_cpp/bt_factory.h"
#include "scripted_nodes.h"
#include "tinyxml2.h"

namespace
{
using namespace scripted;
using tinyxml2::XMLElement;

constexpr int TICK_MS = 100;
constexpr int TICKS = 60;

BT::PortInfo port_of(const XMLElement* element, const std::string& type)
{
  const bool output = std::string(element->Name()) == "output_port";
  BT::PortInfo port = type_called(type).port(output ? BT::PortDirection::OUTPUT : BT::PortDirection::INPUT);
  if(const char* text = element->Attribute("default"))
  {
    port.setDefaultValue(std::string(text));
  }
  return port;
}

// The nodes of a TreeNodesModel; those that are trees are kept too, for the types of their ports.
std::map<std::string, Declared> declared_in(const XMLElement* root)
{
  std::map<std::string, Declared> found;
  const XMLElement* models = root->FirstChildElement("TreeNodesModel");
  for(auto node = models->FirstChildElement(); node != nullptr; node = node->NextSiblingElement())
  {
    Declared& declared = found[node->Attribute("ID")];
    declared.id = node->Attribute("ID");
    declared.kind = node->Name();
    for(auto port = node->FirstChildElement(); port != nullptr; port = port->NextSiblingElement())
    {
      const std::string kind = port->Name();
      if(kind != "input_port" && kind != "output_port")
      {
        continue;
      }
      const char* type = port->Attribute("type");
      (kind == "input_port" ? declared.inputs : declared.outputs)[port->Attribute("name")] = type ? type : "";
      declared.ports[port->Attribute("name")] = port_of(port, type ? type : "");
    }
  }
  return found;
}

template <typename Node>
void register_as(BT::BehaviorTreeFactory& factory, BT::NodeType kind, const Declared& declared)
{
  factory.registerBuilder({ kind, declared.id, declared.ports, {} },
                          [&declared](const std::string& name, const BT::NodeConfig& config) {
                            return std::make_unique<Node>(name, config, declared);
                          });
}

void register_all(BT::BehaviorTreeFactory& factory, const std::map<std::string, Declared>& nodes)
{
  for(const auto& [id, declared] : nodes)
  {
    if(declared.kind == "Action")
    {
      register_as<Action>(factory, BT::NodeType::ACTION, declared);
    }
    else if(declared.kind == "Condition")
    {
      register_as<Condition>(factory, BT::NodeType::CONDITION, declared);
    }
    else if(declared.kind == "Decorator")
    {
      register_as<Decorator>(factory, BT::NodeType::DECORATOR, declared);
    }
    else if(declared.kind == "Control")
    {
      register_as<Control>(factory, BT::NodeType::CONTROL, declared);
    }
  }
  factory.registerNodeType<VirtualSleep>("VirtualSleep", BT::PortsList{ BT::InputPort<unsigned>("msec") });
  factory.registerNodeType<VirtualTimeout>("VirtualTimeout", BT::PortsList{ BT::InputPort<unsigned>("msec") });
  factory.addSubstitutionRule("Sleep", "VirtualSleep");
  factory.addSubstitutionRule("Timeout", "VirtualTimeout");
}

// Collects the entries that ports of one direction name, with the first type that a node below declares for each.
void entries_of(const XMLElement* element, const std::map<std::string, Declared>& nodes,
                std::map<std::string, std::string> Declared::*direction, std::map<std::string, std::string>& found)
{
  const char* id = element->Attribute("ID");
  const auto node = nodes.find(id != nullptr ? id : element->Name());
  if(node != nodes.end())
  {
    for(const auto& [name, type] : node->second.*direction)
    {
      BT::StringView key;
      const char* value = element->Attribute(name.c_str());
      if(value != nullptr && BT::TreeNode::isBlackboardPointer(value, &key))
      {
        found.emplace(key, type);
      }
    }
  }
  for(auto child = element->FirstChildElement(); child != nullptr; child = child->NextSiblingElement())
  {
    entries_of(child, nodes, direction, found);
  }
}

// Gives every entry that the main tree reads and does not write a value of the type that it is read as.
void give_inputs(BT::Blackboard& board, const XMLElement* main, const std::map<std::string, Declared>& nodes)
{
  std::map<std::string, std::string> read;
  std::map<std::string, std::string> written;
  entries_of(main, nodes, &Declared::inputs, read);
  entries_of(main, nodes, &Declared::outputs, written);
  for(const auto& [name, type] : read)
  {
    if(written.count(name) == 0)
    {
      type_called(type).given(board, name);
    }
  }
}

std::string run(const std::string& path)
{
  tinyxml2::XMLDocument document;
  if(document.LoadFile(path.c_str()) != tinyxml2::XML_SUCCESS)
  {
    throw BT::RuntimeError(document.ErrorStr());
  }
  const XMLElement* root = document.RootElement();
  const auto nodes = declared_in(root);
  BT::BehaviorTreeFactory factory;
  register_all(factory, nodes);
  factory.registerBehaviorTreeFromFile(path);
  const std::string main = root->Attribute("main_tree_to_execute");
  const auto board = BT::Blackboard::create();
  for(auto tree = root->FirstChildElement("BehaviorTree"); tree != nullptr;
      tree = tree->NextSiblingElement("BehaviorTree"))
  {
    if(tree->Attribute("ID") == main)
    {
      give_inputs(*board, tree, nodes);
    }
  }
  BT::Tree tree = factory.createTree(main, board);
  NodeStatus status = NodeStatus::RUNNING;
  for(int tick = 0; tick < TICKS && status == NodeStatus::RUNNING; ++tick)
  {
    stage->now_ms = tick * TICK_MS;
    status = tree.tickExactlyOnce();
    stage->tell("=", BT::toStr(status));
  }
  tree.haltTree();
  return BT::toStr(status);
}
}  // namespace

int main(int count, char** arguments)
{
  if(count == 2 && std::string(arguments[1]) == "--registered")
  {
    BT::BehaviorTreeFactory factory;
    const std::set<std::string> names(factory.builtinNodes().begin(), factory.builtinNodes().end());
    for(const auto& name : names)
    {
      std::cout << name << "\n";
    }
    return 0;
  }
  for(std::string path; std::getline(std::cin, path);)
  {
    Stage current;
    stage = &current;
    std::string ending;
    try
    {
      ending = "end " + run(path);
    }
    catch(const std::exception& error)
    {
      ending = "refused " + quoted(error.what());
    }
    std::cout << current.trace.str() << ending << std::endl;
  }
}
